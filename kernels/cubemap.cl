// The cube map (layout.h): look-up along a direction, bilinear, seamless by its border.

typedef struct cube_point {
    lanes_int first; // index of the upper left of the four texels
    real right, down; // [0, 1): how far the point lies towards the right and the lower ones
} cube_point;

// Where a direction of any length but zero meets the cube. On a tie of the largest components the
// order x, y, z decides, as in ImfEnvmap.h; the border makes both answers agree.
static inline cube_point find_on_cube(real3 d, int edge)
{
    real ax = fabs(d.x), ay = fabs(d.y), az = fabs(d.z);
    mask x_major = (ax >= ay) & (ax >= az);
    mask y_major = !x_major & (ay >= az);
    real major = SELECT(x_major, ax, SELECT(y_major, ay, az));
    real along = SELECT(x_major, d.x, SELECT(y_major, d.y, d.z));
    mask negative = along < R(0.0);

    // The table of layout.h, as selections: s is ±z, x or ∓x; t is −y, ∓z or −y.
    real s_x = SELECT(negative, -d.z, d.z);
    real s_z = SELECT(negative, d.x, -d.x);
    real t_y = SELECT(negative, d.z, -d.z);
    real s = SELECT(x_major, s_x, SELECT(y_major, d.x, s_z));
    real t = SELECT(y_major, t_y, -d.y);
    lanes_int face = SELECT(x_major, int_of(0), SELECT(y_major, int_of(2), int_of(4)));
    face = SELECT(negative, face + (lane_int)1, face);

    // Texel i has its centre at s = (2i + 1)/edge − 1 and stands in column i + 1.
    scalar half_edge = (scalar)edge * R(0.5);
    real column = fused(s / major, real_of(half_edge), real_of(half_edge + R(0.5)));
    real row = fused(t / major, real_of(half_edge), real_of(half_edge + R(0.5)));
    // A direction that is not finite must not read outside: NaN compares false and becomes 0.
    real last = real_of((scalar)edge + R(0.5));
    column = SELECT(column > R(0.0), SMALLER(column, last), real_of(0));
    row = SELECT(row > R(0.0), SMALLER(row, last), real_of(0));

    lanes_int i = to_int_down(column), j = to_int_down(row);
    lane_int pitch = edge + 2 * GLINT_CUBE_BORDER;
    cube_point point;
    point.first = (face * pitch + j) * pitch + i;
    point.right = column - to_real(i);
    point.down = row - to_real(j);
    return point;
}

// R, G, B and a fourth value of one texel.
static inline scalar4 load_texel(global const float *texel)
{
#if GLINT_DOUBLE
    return convert_double4(vload4(0, texel));
#else
    return vload4(0, texel);
#endif
}

// The value of the map along d, for the rays in `wanted`; the others get 0.
static inline real3 sample_cube(global const float *texels, int edge, real3 d, mask wanted)
{
    cube_point point = find_on_cube(d, edge);
    size_t pitch = (size_t)(edge + 2 * GLINT_CUBE_BORDER);
    real3 value = real3_of(real_of(0), real_of(0), real_of(0));
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        if (!lane_is_set(wanted, lane)) {
            continue;
        }
        global const float *corner = texels + 4 * (size_t)LANE_INT(point.first, lane);
        scalar4 top_left = load_texel(corner), top_right = load_texel(corner + 4);
        scalar4 bottom_left = load_texel(corner + 4 * pitch);
        scalar4 bottom_right = load_texel(corner + 4 * pitch + 4);
        scalar4 right = LANE(point.right, lane), down = LANE(point.down, lane);
        scalar4 top = fused(right, top_right - top_left, top_left);
        scalar4 bottom = fused(right, bottom_right - bottom_left, bottom_left);
        scalar4 found = fused(down, bottom - top, top);
        LANE(value.x, lane) = found.x;
        LANE(value.y, lane) = found.y;
        LANE(value.z, lane) = found.z;
    }
    return value;
}
