// Looks up the cube map (layout.h) along a direction: bilinear, and seamless because of its border.

typedef struct cube_map {
    global const void *texels;
    int edge;      // texels along a face's edge, without the border
    bool are_half; // texels are half, else float; a constant in special kernels
} cube_map;

typedef struct cube_point {
    lanes_int first;  // index of the upper left of the four texels
    real right, down; // [0, 1): position towards the right and the lower texels
} cube_point;

// Finds the point of the cube in a direction of any length but zero. If the largest components tie,
// the border makes all answers agree. `edge` is the edge of the map or of one of its levels, which
// begins at the texel `start`.
static inline cube_point find_on_cube(real3 d, lanes_int edge, lanes_int start)
// Find the face and the coordinates on it.
{
    mask x_major, y_major;
    find_major(d, &x_major, &y_major);
    real ax = fabs(d.x), ay = fabs(d.y), az = fabs(d.z);
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
    real half_edge = to_real(edge) * R(0.5);
    real per_major = half_edge / major;
    real column = fused(s, per_major, half_edge + R(0.5));
    real row = fused(t, per_major, half_edge + R(0.5));
    // A direction that is not finite must not read outside the map: NaN compares false and becomes
    // 0.
    real last = to_real(edge) + R(0.5);
    column = SELECT(column > R(0.0), SMALLER(column, last), real_of(0));
    row = SELECT(row > R(0.0), SMALLER(row, last), real_of(0));

    // Neither value is negative, so truncation rounds down.
    lanes_int i = to_int_truncated(column), j = to_int_truncated(row);
    lanes_int pitch = edge + (lane_int)(2 * GLINT_CUBE_BORDER);
    cube_point point;
    point.first = start + face * (pitch * pitch) + (j * pitch + i);
    point.right = column - to_real(i);
    point.down = row - to_real(j);
    return point;
}

// The face of a point on the map itself (not on a coarser level).
static inline lanes_int face_of(const cube_map *map, const cube_point *point)
{
    const lane_int pitch = map->edge + 2 * GLINT_CUBE_BORDER;
    return point->first / (pitch * pitch);
}

// R, G, B and a fourth value of two neighbouring texels.
static inline scalar8 load_texels(const cube_map *map, size_t place)
{
    return TO_SCALAR8(map->are_half ? vload_half8(0, (global const half *)map->texels + 4 * place)
                                    : vload8(0, (global const float *)map->texels + 4 * place));
}

// Prefetches the texels that fetch_from_cube will read.
static inline void prefetch_texels(const cube_map *map, int edge, size_t first)
{
    const size_t size = map->are_half ? 4 * sizeof(half) : 4 * sizeof(float);
    const size_t pitch = (size_t)(edge + 2 * GLINT_CUBE_BORDER);
    global const char *texel = (global const char *)map->texels + size * first;
    prefetch_line(texel);
    prefetch_line(texel + size * pitch);
}

// R, G, B and a fourth value at one ray's point. `first` is the upper left texel, of the map or of
// a level of the given edge. Two texels are a vector of eight. So the code interpolates downwards
// first, then to the right. This order, and so the bits, are the same at every width.
static inline scalar4 fetch_from_cube(const cube_map *map, int edge, size_t first, scalar right,
                                      scalar down)
{
    size_t pitch = (size_t)(edge + 2 * GLINT_CUBE_BORDER);
    scalar8 upper = load_texels(map, first), lower = load_texels(map, first + pitch);
    scalar8 sides = fused((scalar8)down, lower - upper, upper);
    return fused((scalar4)right, sides.hi - sides.lo, sides.lo);
}

// The value of the map along d, for the rays in `wanted`; the others get 0.
static inline real3 sample_cube(const cube_map *map, real3 d, mask wanted)
{
    cube_point point = find_on_cube(d, int_of(map->edge), int_of(0));
    real3 value = real3_of(real_of(0), real_of(0), real_of(0));
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        if (!lane_is_set(wanted, lane)) {
            continue;
        }
        scalar4 found = fetch_from_cube(map, map->edge, (size_t)LANE_INT(point.first, lane),
                                        LANE(point.right, lane), LANE(point.down, lane));
        LANE(value.x, lane) = found.x;
        LANE(value.y, lane) = found.y;
        LANE(value.z, lane) = found.z;
    }
    return value;
}
