// Closest hits of the primary rays through a tile of pixels: one traversal for all of them.
//
// All primary rays come from one eye (or run alike), and their directions are affine in the pixel, so
// that the scene can be looked at in image coordinates, (x, y, h) with x/h and y/h the place on the
// image plane in pixels from its middle and z the depth (glint_frame_record). There a triangle's
// edge is an affine function of the pixel, and so is the key that orders surfaces by depth.
//
// Which pixels a triangle covers is decided as Woop, Benthin and Wald do (intersect.cl): the vertices
// are sheared by the pixel, and the signs of rounded products are never wrong. The affine functions
// tell the same for nearly every pixel at a fraction of the cost; where one of them is closer to 0
// than both ways' rounding errors together, the slow way decides. So every tile size and width finds
// the same hits.
//
// A tile is TILE_COLUMNS × TILE_ROWS groups of pixels, each as many as a packet has lanes.
#define TILE_COLUMNS GLINT_TILE_SIDE(GLINT_TILES)
#define TILE_ROWS GLINT_TILE_SIDE(GLINT_TILES)
#define TILE_GROUPS (TILE_COLUMNS * TILE_ROWS)

// The primary rays of a frame in image coordinates.
typedef struct image_space {
    scalar origin[3];        // where the middle ray starts, stored coordinates
    scalar rows[3][3];       // x, y and z of a point relative to it
    scalar offset, slope;    // h = offset + slope z
    scalar key_one, key_depth, key_normal; // see image_key
    scalar key_limit;        // of the depth 0, where the rays start
} image_space;

// What a tile's rays have met so far, and what its traversal needs.
typedef struct tile {
    // Places on the image plane: of the pixels of each column and row of groups, of the groups'
    // centres and of the tile's; the largest magnitudes in the tile.
    real x[TILE_COLUMNS], y[TILE_ROWS];
    block center_x, center_y;
    scalar middle_x, middle_y;
    scalar largest_x, largest_y;
    scalar planes[4][3], plane_offsets[4]; // inside is ≥ 0; of points relative to the origin
    real key[TILE_GROUPS];         // of the nearest hit; see image_key
    lanes_int place[TILE_GROUPS];  // of the triangle hit, −1: none
    block farthest;                // the least key of each group
    scalar least;                  // and of the tile
    scalar z_far;                  // no hit of the tile lies deeper
} tile;

// The functions of the 16 triangles of a cluster, each affine in the pixel: [x, y, 1].
typedef struct image_triangles {
    block edges[3][3]; // ≥ 0 inside
    block uncertain;   // edges closer to 0 than this may have the wrong sign
    block key[3];
    block key_largest; // at the vertices
    block reach[3];    // how far the edges may rise from a group's centre
    block key_reach;   // and the key
} image_triangles;

static inline image_space make_image_space(const glint_frame_record *frame)
{
    image_space s;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        s.origin[k] = JOIN(frame->origin.high[k], frame->origin.low[k]);
        s.rows[0][k] = JOIN(frame->image_x.high[k], frame->image_x.low[k]);
        s.rows[1][k] = JOIN(frame->image_y.high[k], frame->image_y.low[k]);
        s.rows[2][k] = JOIN(frame->image_z.high[k], frame->image_z.low[k]);
    }
    s.offset = JOIN(frame->image_offset[0], frame->image_offset[1]);
    s.slope = frame->image_slope;
    s.key_one = frame->key_is_inverse ? R(1.0) : R(0.0);
    s.key_depth = R(1.0) - s.key_one;
    s.key_normal = frame->key_is_inverse ? R(1.0) : s.offset;
    s.key_limit = frame->key_is_inverse ? HUGE : R(0.0);
    return s;
}

// The key of a depth, larger for nearer: 1/h for an eye near the scene, else −z/h. Both are affine
// in the pixel on any plane; the second keeps its digits where the eye is far away or infinitely so.
static inline block image_key(const image_space *s, block z, block h)
{
    return (s->key_one - s->key_depth * z) / h;
}

// ---- The tile and the tree ---------------------------------------------------------------------

// The four planes through the tile's outermost rays, a little apart from them: x − X h ≥ 0 for the
// left one, as a function of the place in stored coordinates. `margin` is what its own rounding
// takes of the part that does not depend on the place.
static inline void bound_tile(const image_space *s, tile *t, int plane, int row, scalar at,
                              scalar sign)
{
#pragma unroll
    for (int k = 0; k < 3; k++) {
        t->planes[plane][k] = sign * (s->rows[row][k] - at * (s->slope * s->rows[2][k]));
    }
    scalar offset = -at * s->offset;
    t->plane_offsets[plane] = sign * offset + R(4.0) * EPSILON * fabs(offset);
}

// How far the outermost pixels of a group and of the tile lie from its middle.
#define GROUP_HALF_X (R(0.5) * (scalar)(PACKET_WIDTH - 1))
#define GROUP_HALF_Y (R(0.5) * (scalar)(PACKET_HEIGHT - 1))
#define TILE_HALF_X (R(0.5) * (scalar)(PACKET_WIDTH * TILE_COLUMNS - 1))
#define TILE_HALF_Y (R(0.5) * (scalar)(PACKET_HEIGHT * TILE_ROWS - 1))

// Columns and rows of a group's pixels, counted in the image.
static inline lanes_int group_columns(int tile_column, int group)
{
    return lane_numbers() % (lane_int)PACKET_WIDTH +
           (lane_int)(tile_column + group % TILE_COLUMNS * PACKET_WIDTH);
}
static inline lanes_int group_rows(int tile_row, int group)
{
    return lane_numbers() / (lane_int)PACKET_WIDTH +
           (lane_int)(tile_row + group / TILE_COLUMNS * PACKET_HEIGHT);
}

static inline mask group_in_image(const glint_frame_record *frame, int tile_column, int tile_row,
                                  int group)
{
    mask across = group_columns(tile_column, group) < (lane_int)frame->width;
    mask down = group_rows(tile_row, group) < (lane_int)frame->height;
    return across & down;
}

// The places on the image plane of samples that lie (right, down) from the upper left corner of
// their pixels. All but the last operation is exact: the same for every size of tiles.
static inline real place_x(const glint_frame_record *frame, lanes_int columns, scalar right)
{
    return to_real(columns) - R(0.5) * (scalar)frame->width + right;
}
static inline real place_y(const glint_frame_record *frame, lanes_int rows, scalar down)
{
    return R(0.5) * (scalar)frame->height - to_real(rows) - down;
}

// Nothing is met yet. Pixels outside the image hide everything, so that nothing is visited for them.
static inline void clear_tile(const image_space *s, const glint_frame_record *frame, int column,
                              int row, tile *t)
{
    scalar nothing = s->key_one > 0 ? R(0.0) : -HUGE;
    t->farthest = block_of(HUGE);
    for (int g = 0; g < TILE_GROUPS; g++) {
        mask inside = group_in_image(frame, column, row, g);
        t->key[g] = SELECT(inside, real_of(nothing), real_of(HUGE));
        t->place[g] = int_of(-1);
        ((scalar *)&t->farthest)[g] = smallest_lane(t->key[g]);
    }
    t->least = nothing;
    t->z_far = HUGE;
}

// `column` and `row` name the tile's first pixel.
static inline void begin_tile(const image_space *s, const glint_frame_record *frame, int column,
                              int row, scalar right, scalar down, tile *t)
{
    for (int i = 0; i < TILE_COLUMNS; i++) {
        t->x[i] = place_x(frame, group_columns(column, i), right);
    }
    for (int i = 0; i < TILE_ROWS; i++) {
        t->y[i] = place_y(frame, group_rows(row, i * TILE_COLUMNS), down);
    }
    scalar low_x = LANE(t->x[0], 0), high_y = LANE(t->y[0], 0);
    scalar high_x = low_x + R(2.0) * TILE_HALF_X, low_y = high_y - R(2.0) * TILE_HALF_Y;
    t->middle_x = low_x + TILE_HALF_X;
    t->middle_y = high_y - TILE_HALF_Y;
    t->largest_x = LARGER(fabs(low_x), fabs(high_x));
    t->largest_y = LARGER(fabs(low_y), fabs(high_y));
    t->center_x = t->center_y = block_of(0);
    for (int g = 0; g < TILE_GROUPS; g++) {
        ((scalar *)&t->center_x)[g] =
            low_x + GROUP_HALF_X + (scalar)(g % TILE_COLUMNS * PACKET_WIDTH);
        ((scalar *)&t->center_y)[g] =
            high_y - GROUP_HALF_Y - (scalar)(g / TILE_COLUMNS * PACKET_HEIGHT);
    }
    bound_tile(s, t, 0, 0, low_x, R(1.0));
    bound_tile(s, t, 1, 0, high_x, R(-1.0));
    bound_tile(s, t, 2, 1, low_y, R(1.0));
    bound_tile(s, t, 3, 1, high_y, R(-1.0));
    clear_tile(s, frame, column, row, t);
}

// Bit c is set if the tile's rays may meet box c of the node before what all of them have hit;
// `near` is the least depth at which they may.
static inline uint tile_meets_boxes(const image_space *s, const tile *t, global const float *node,
                                    boxes *near)
{
    boxes corner[6]; // low x, y, z, high x, y, z, relative to the origin
#pragma unroll
    for (int k = 0; k < 6; k++) {
        corner[k] = load_boxes(node + k * GLINT_BVH_WIDTH) - s->origin[k % 3];
    }
    // Rounding displaces what lies in a box, seen from the origin, by a few parts in 2²⁴ of its
    // distance at most.
    boxes most = LARGER(corner[3], LARGER(corner[4], corner[5]));
    boxes least = SMALLER(corner[0], SMALLER(corner[1], corner[2]));
    boxes slack = LARGER(most, -least) * (R(32.0) * EPSILON);
#pragma unroll
    for (int k = 0; k < 3; k++) {
        corner[k] -= slack;
        corner[k + 3] += slack;
    }
    const scalar *z = s->rows[2];
    const int zx = z[0] > 0 ? 3 : 0, zy = z[1] > 0 ? 3 : 0, zz = z[2] > 0 ? 3 : 0;
    boxes far = corner[zx] * z[0] + corner[1 + zy] * z[1] + corner[2 + zz] * z[2];
    *near = corner[3 - zx] * z[0] + corner[4 - zy] * z[1] + corner[5 - zz] * z[2];
    boxes_mask met = (far >= R(0.0)) & (*near <= t->z_far);
#pragma unroll
    for (int p = 0; p < 4; p++) {
        const scalar *n = t->planes[p];
        const int nx = n[0] > 0 ? 3 : 0, ny = n[1] > 0 ? 3 : 0, nz = n[2] > 0 ? 3 : 0;
        boxes side = corner[nx] * n[0] + corner[1 + ny] * n[1] + corner[2 + nz] * n[2];
        met &= side >= -t->plane_offsets[p];
    }
    return box_bits(met);
}

// ---- Triangles ---------------------------------------------------------------------------------

// x, y, z and h of the cluster's vertices.
static inline void to_image(const image_space *s, global const float *cluster, block v[4])
{
    block d[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        d[k] = load_block(cluster + GLINT_CLUSTER_LANES * k) - s->origin[k];
    }
#pragma unroll
    for (int r = 0; r < 3; r++) {
        v[r] = fused(block_of(s->rows[r][0]), d[0],
                     fused(block_of(s->rows[r][1]), d[1], s->rows[r][2] * d[2]));
    }
    v[3] = fused(block_of(s->slope), v[2], block_of(s->offset));
}

// The function of the edge from a to b: 2 (a × b)·(X, Y, 1), as (a + b) × (b − a). Changing the ends
// changes nothing but the sign, so that both triangles at an edge agree about its pixels.
static inline void edge_function(const block a[4], const block b[4], block edge[3])
{
    block sx = a[0] + b[0], sy = a[1] + b[1], sh = a[3] + b[3];
    block dx = b[0] - a[0], dy = b[1] - a[1], dh = b[3] - a[3];
    edge[0] = fused(sy, dh, -(sh * dy));
    edge[1] = fused(sh, dx, -(sx * dh));
    edge[2] = fused(sx, dy, -(sy * dx));
}

// The key's function on the triangles' planes, from the plane n·(x, y, z) = D with x = X h, y = Y h:
// (A (n_x X + n_y Y) + B n_z − C D)/(slope D + offset n_z), see image_key. `side` is the denominator:
// twice the volume that the triangle spans with the eye, above 0 if it winds left.
static inline void key_function(const image_space *s, block corners[3][4], block key[3],
                                block *side)
{
    block u[3], v[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        u[k] = corners[1][k] - corners[0][k];
        v[k] = corners[2][k] - corners[0][k];
    }
    block nx = fused(u[1], v[2], -(u[2] * v[1]));
    block ny = fused(u[2], v[0], -(u[0] * v[2]));
    block nz = fused(u[0], v[1], -(u[1] * v[0]));
    block d = fused(nx, corners[0][0], fused(ny, corners[0][1], nz * corners[0][2]));
    *side = fused(block_of(s->slope), d, s->offset * nz);
    block inverse = R(1.0) / *side;
    key[0] = nx * s->key_normal * inverse;
    key[1] = ny * s->key_normal * inverse;
    key[2] = (s->key_one * nz - s->key_depth * d) * inverse;
}

// How large the triangles' edges and places are in the tile: what rounding errors grow with.
static inline block rounding_bound(const tile *t, block corners[3][4], block *largest_h)
{
    block place_x = 0, place_y = 0, edge_x = 0, edge_y = 0;
    *largest_h = 0;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const block *a = corners[k], *b = corners[(k + 1) % 3];
        block h = fabs(a[3]), dh = fabs(b[3] - a[3]);
        *largest_h = LARGER(h, *largest_h);
        block x = fused(h, block_of(t->largest_x), fabs(a[0]));
        block y = fused(h, block_of(t->largest_y), fabs(a[1]));
        block dx = fused(dh, block_of(t->largest_x), fabs(b[0] - a[0]));
        block dy = fused(dh, block_of(t->largest_y), fabs(b[1] - a[1]));
        place_x = LARGER(x, place_x);
        place_y = LARGER(y, place_y);
        edge_x = LARGER(dx, edge_x);
        edge_y = LARGER(dy, edge_y);
    }
    return (place_x * edge_y + place_y * edge_x) * (R(32.0) * EPSILON);
}

// The functions of a cluster's triangles, and which of them may be seen in the tile.
static inline uint make_image_triangles(const image_space *s, const tile *t,
                                        global const float *cluster, const block vertices[4],
                                        image_triangles *out)
{
    global const uchar *indices = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
    block corners[3][4];
    block keys = SELECT(vertices[3] > R(0.0), image_key(s, vertices[2], vertices[3]),
                        block_of(HUGE));
    out->key_largest = -HUGE;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        uchar16 lanes = vload16(k, indices);
#pragma unroll
        for (int r = 0; r < 4; r++) {
            corners[k][r] = permute_block(vertices[r], lanes);
        }
        block key = permute_block(keys, lanes);
        out->key_largest = LARGER(key, out->key_largest);
    }
    block side, largest_h;
    key_function(s, corners, out->key, &side);
    block bound = rounding_bound(t, corners, &largest_h);
    // A triangle seen (nearly) edge-on may wind either way: nothing is certain about it.
    block_mask edge_on = !(fabs(side) > R(2.0) * largest_h * bound);
    out->uncertain = SELECT(edge_on, block_of(HUGE), bound);

    global const int *facts = (global const int *)cluster;
    block_mask seen = block_of(facts[GLINT_CLUSTER_COUNT]) > BLOCK_LANES;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        block *edge = out->edges[k];
        edge_function(corners[(k + 1) % 3], corners[(k + 2) % 3], edge);
#pragma unroll
        for (int i = 0; i < 3; i++) {
            edge[i] = SELECT(side < R(0.0), -edge[i], edge[i]);
        }
        block ax = fabs(edge[0]), ay = fabs(edge[1]);
        block middle = fused(edge[0], block_of(t->middle_x), fused(edge[1], block_of(t->middle_y), edge[2]));
        block rise = fused(ax, block_of(TILE_HALF_X), fused(ay, block_of(TILE_HALF_Y), out->uncertain));
        seen &= middle >= -rise;
        out->reach[k] = fused(ax, block_of(GROUP_HALF_X), fused(ay, block_of(GROUP_HALF_Y), out->uncertain));
    }
    block ax = fabs(out->key[0]), ay = fabs(out->key[1]);
    block error = (fused(ax, block_of(t->largest_x), fused(ay, block_of(t->largest_y),
                                                          fabs(out->key[2])))) * (R(8.0) * EPSILON);
    block middle = fused(out->key[0], block_of(t->middle_x),
                         fused(out->key[1], block_of(t->middle_y), out->key[2]));
    block highest = fused(ax, block_of(TILE_HALF_X), fused(ay, block_of(TILE_HALF_Y), middle + error));
    seen &= (highest >= t->least) & (out->key_largest >= t->least);
    out->key_reach = fused(ax, block_of(GROUP_HALF_X), fused(ay, block_of(GROUP_HALF_Y), error));
    return block_bits(seen);
}

// The groups of the tile that a triangle may cover, and where it may be nearer than what is there.
static inline uint groups_of(const tile *t, const image_triangles *triangles, int i)
{
#define OF(values) block_of(((const scalar *)&(values))[i])
    block_mask met = (block_mask)-1;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const block *edge = triangles->edges[k];
        block at = fused(OF(edge[0]), t->center_x, fused(OF(edge[1]), t->center_y, OF(edge[2])));
        met &= at >= -OF(triangles->reach[k]);
    }
    const block *key = triangles->key;
    block at = fused(OF(key[0]), t->center_x, fused(OF(key[1]), t->center_y, OF(key[2])));
    met &= (at + OF(triangles->key_reach) >= t->farthest) & (OF(triangles->key_largest) >= t->farthest);
    return block_bits(met);
#undef OF
}

// ---- Pixels ------------------------------------------------------------------------------------

// A triangle's corners [corner][x, y, z, h], each the same for all pixels or one for each.
typedef struct image_corners {
    real at[3][4];
} image_corners;

// The signs of u, v and w say whether the pixels at (x, y) see the triangle; divided by their sum
// they are the barycentric weights. Not fused: see intersect.cl.
static inline mask image_weights(const image_corners *c, real x, real y, real weights[3])
{
    real cx[3], cy[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        cx[k] = fused(-x, c->at[k][3], c->at[k][0]);
        cy[k] = fused(-y, c->at[k][3], c->at[k][1]);
    }
    real u = cx[1] * cy[2] - cy[1] * cx[2];
    real v = cx[2] * cy[0] - cy[2] * cx[0];
    real w = cx[0] * cy[1] - cy[0] * cx[1];
    weights[0] = u;
    weights[1] = v;
    weights[2] = w;
    mask inside = ((u >= R(0.0)) & (v >= R(0.0)) & (w >= R(0.0))) |
                  ((u <= R(0.0)) & (v <= R(0.0)) & (w <= R(0.0)));
    return inside & (u + v + w != R(0.0)) & (SMALLEST3(cx[0], cx[1], cx[2]) <= R(0.0)) &
           (LARGEST3(cx[0], cx[1], cx[2]) >= R(0.0)) & (SMALLEST3(cy[0], cy[1], cy[2]) <= R(0.0)) &
           (LARGEST3(cy[0], cy[1], cy[2]) >= R(0.0));
}

// The slow way, for pixels where an edge's function is too close to 0.
static inline mask covers_exactly(const block vertices[4], global const float *cluster, int i,
                                  real x, real y)
{
    global const uchar *indices = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
    image_corners c;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        int lane = indices[k * GLINT_CLUSTER_LANES + i];
#pragma unroll
        for (int r = 0; r < 4; r++) {
            c.at[k][r] = real_of(((const scalar *)&vertices[r])[lane]);
        }
    }
    real weights[3];
    return image_weights(&c, x, y, weights);
}

// Of two triangles at one depth the one with the lower number in the scene is seen.
static inline mask has_lower_number(global const int *numbers, int place, lanes_int other, mask wanted)
{
    lanes_int lower = int_of(0);
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        if (lane_is_set(wanted, lane)) {
            int rival = (int)LANE_INT(other, lane);
            LANE_INT(lower, lane) = rival < 0 || numbers[place] < numbers[rival];
        }
    }
    return lower != (lane_int)0;
}

// Tests triangle i of a cluster against the pixels of one group; true if any sees it.
static inline bool meet_group(const image_space *s, tile *t, const image_triangles *triangles, const block vertices[4],
                              global const float *cluster, global const int *numbers,
                              int cluster_index, int i, int g)
{
#define OF(values) real_of(((const scalar *)&(values))[i])
    real x = t->x[g % TILE_COLUMNS], y = t->y[g / TILE_COLUMNS];
    const block(*edges)[3] = triangles->edges;
    real e0 = fused(OF(edges[0][0]), x, fused(OF(edges[0][1]), y, OF(edges[0][2])));
    real e1 = fused(OF(edges[1][0]), x, fused(OF(edges[1][1]), y, OF(edges[1][2])));
    real e2 = fused(OF(edges[2][0]), x, fused(OF(edges[2][1]), y, OF(edges[2][2])));
    real key = fused(OF(triangles->key[0]), x,
                     fused(OF(triangles->key[1]), y, OF(triangles->key[2])));
    // Never nearer than the nearest corner, whatever rounding says: that is what culling rests on.
    key = SMALLER(key, OF(triangles->key_largest));
    real least = SMALLER(e0, e1);
    least = SMALLER(least, e2);
    real uncertain = OF(triangles->uncertain);
    mask seen = (least >= -uncertain) & (key >= t->key[g]);
    if (!any_lane(seen)) {
        return false;
    }
    if (((const scalar *)&triangles->key_largest)[i] > s->key_limit) {
        seen &= key <= s->key_limit; // what lies behind the start is not seen
    }
    if (any_lane(seen & (least <= uncertain))) {
        seen &= (least > uncertain) | covers_exactly(vertices, cluster, i, x, y);
    }
    int place = cluster_index * GLINT_CLUSTER_LANES + i;
    mask tied = seen & (key == t->key[g]);
    if (any_lane(tied)) {
        seen &= !tied | has_lower_number(numbers, place, t->place[g], tied);
    }
    t->key[g] = SELECT(seen, key, t->key[g]);
    t->place[g] = SELECT(seen, int_of(place), t->place[g]);
    return any_lane(seen);
#undef OF
}

// The depth beyond which nothing is seen in the tile, from the least key.
static inline void update_depth(const image_space *s, tile *t, uint changed)
{
    while (changed != 0) {
        int g = lowest_bit(changed);
        changed &= changed - 1;
        ((scalar *)&t->farthest)[g] = smallest_lane(t->key[g]);
    }
    scalar smallest = smallest_of_16(t->farthest);
    t->least = smallest;
    if (smallest > (s->key_one > 0 ? R(0.0) : R(-0.5) * HUGE)) {
        scalar z = (s->key_one - smallest * s->offset) / (s->key_depth + smallest * s->slope);
        t->z_far = z + (fabs(z) + s->offset) * (R(64.0) * EPSILON);
    }
}

static inline void meet_cluster(const image_space *s, tile *t, const scene_buffers *scene, int index)
{
    global const float *cluster = scene->clusters + GLINT_CLUSTER_VALUES * (size_t)index;
    block vertices[4];
    to_image(s, cluster, vertices);
    image_triangles triangles;
    uint seen = make_image_triangles(s, t, cluster, vertices, &triangles);
    uint changed = 0;
    while (seen != 0) {
        int i = lowest_bit(seen);
        seen &= seen - 1;
        uint groups = TILE_GROUPS > 1 ? groups_of(t, &triangles, i) : 1;
        while (groups != 0) {
            int g = lowest_bit(groups);
            groups &= groups - 1;
            if (meet_group(s, t, &triangles, vertices, cluster, scene->numbers, index, i, g)) {
                changed |= 1u << g;
            }
        }
    }
    if (changed != 0) {
        update_depth(s, t, changed);
    }
}

static inline void trace_tile(const image_space *s, tile *t, const scene_buffers *scene)
{
    waiting stack[GLINT_TRAVERSAL_STACK];
    stack[0].child = 0;
    stack[0].entry = -HUGE;
    int size = 1;
    while (size > 0) {
        waiting next = stack[--size];
        if (next.entry > t->z_far) {
            continue;
        }
        if (next.child < 0) {
            meet_cluster(s, t, scene, ~next.child);
            continue;
        }
        boxes near;
        uint met = tile_meets_boxes(s, t, node_at(scene, next.child), &near);
        int base = size;
        for (; met != 0; met &= met - 1) {
            int child = lowest_bit(met);
            size = push_waiting(scene, stack, base, size, next.child, child, ((scalar *)&near)[child]);
        }
    }
}

// Distances and barycentric weights of what the pixels at (x, y) see, the corners of which are given.
// `length` is that of their directions before they were made unit vectors.
static inline void measure_hits(const image_space *s, const real3 vertices[3], real x, real y,
                                real length, mask met, closest *hit)
{
    image_corners c;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        real dx = vertices[k].x - s->origin[0], dy = vertices[k].y - s->origin[1];
        real dz = vertices[k].z - s->origin[2];
#pragma unroll
        for (int r = 0; r < 3; r++) {
            c.at[k][r] = fused(real_of(s->rows[r][0]), dx,
                               fused(real_of(s->rows[r][1]), dy, s->rows[r][2] * dz));
        }
        c.at[k][3] = fused(real_of(s->slope), c.at[k][2], real_of(s->offset));
    }
    real weights[3];
    image_weights(&c, x, y, weights);
    real inverse = R(1.0) / SELECT(met, weights[0] + weights[1] + weights[2], real_of(1));
    real z = fused(weights[0], c.at[0][2],
                   fused(weights[1], c.at[1][2], weights[2] * c.at[2][2])) * inverse;
    hit->t = SELECT(met, z * length, real_of(HUGE));
    hit->b1 = weights[1] * inverse;
    hit->b2 = weights[2] * inverse;
}
