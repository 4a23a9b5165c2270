// Finds the closest hits of a tile's primary rays with one traversal for the whole tile, in image
// coordinates (tile.cl).
//
// Triangles cover pixels by the watertight test of Woop, Benthin and Wald (intersect.cl). It shears
// the vertices by the pixel, and the signs of rounded products are never wrong. For nearly every
// pixel the affine edge functions give the same answer at a fraction of the cost. If one of them is
// closer to 0 than the rounding errors of both ways together, the slow way decides. So every tile
// size and width finds the same hits.

// The functions of the 16 triangles of a cluster, each affine in the pixel: [x, y, 1].
typedef struct image_triangles {
    block edges[3][3]; // ≥ 0 inside
    block uncertain;   // edges closer to 0 than this may have the wrong sign
    block key[3];
    block key_largest; // at the vertices
    block_mask groups; // groups within the triangle's bounds, as bits
    block reach[3];    // how far the edges may rise from a group's centre
    block key_reach;   // how far the key may rise from a group's centre
#if LOCAL_RAYS
    block_mask wide; // the key has lost its digits: see key_on_plane
#endif
} image_triangles;

// n·p for the corner p of each box that lies farthest along n.
static inline boxes farthest_along(const scalar n[3], node_pointer node)
{
    boxes side = 0;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        boxes corner = load_boxes(node + (n[k] > 0 ? 3 + k : k) * GLINT_BVH_WIDTH);
        side = fused((boxes)n[k], corner, side);
    }
    return side;
}

// Sets bit c if the tile's rays may meet box c of the node before the hits of all of them. `near`
// is the box's least depth.
static inline uint tile_meets_boxes(const image_space *s, const tile *t, node_pointer node,
                                    boxes *near)
{
    const scalar *z = s->rows[2];
    const scalar back[3] = {-z[0], -z[1], -z[2]};
    *near = s->near_offset - farthest_along(back, node);
    boxes_mask met = (farthest_along(z, node) >= s->far_offset) & (*near <= t->z_far);
#pragma unroll
    for (int p = 0; p < 4; p++) {
        met &= farthest_along(t->planes[p], node) >= -t->plane_offsets[p];
    }
    return box_bits(met);
}

// ---- Triangles ---------------------------------------------------------------------------------

// The origin along axis k, relative to the anchor of a cluster's vertices.
static inline scalar image_origin(const image_space *s, global const float *cluster, int k)
{
    scalar origin = FROM_ANCHOR(cluster, k, s->origin[k]);
#if LOCAL_RAYS
    origin += s->origin_low[k];
#endif
    return origin;
}

// x, y, z and h of the cluster's vertices.
static inline void to_image(const image_space *s, global const float *cluster, block v[4])
{
    block d[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        d[k] = load_block(cluster + GLINT_CLUSTER_LANES * k) - image_origin(s, cluster, k);
    }
#pragma unroll
    for (int r = 0; r < 3; r++) {
        v[r] = fused(block_of(s->rows[r][0]), d[0],
                     fused(block_of(s->rows[r][1]), d[1], s->rows[r][2] * d[2]));
    }
    v[3] = fused(block_of(s->slope), v[2], block_of(s->offset));
}

// The function of the edge from a to b: 2 (a × b)·(X, Y, 1), as (a + b) × (b − a). Swapping the
// ends changes only the sign. So both triangles at an edge agree about its pixels.
static inline void edge_function(const block a[4], const block b[4], block edge[3])
{
    block sx = a[0] + b[0], sy = a[1] + b[1], sh = a[3] + b[3];
    block dx = b[0] - a[0], dy = b[1] - a[1], dh = b[3] - a[3];
    edge[0] = fused(sy, dh, -(sh * dy));
    edge[1] = fused(sh, dx, -(sx * dh));
    edge[2] = fused(sx, dy, -(sy * dx));
}

// The key as an affine function of the pixel on each triangle's plane. From the plane n·(x, y, z) =
// D with x = X h, y = Y h it is (A (n_x X + n_y Y) + B n_z − C D)/(slope D + offset n_z), see
// image_key. `side` is the denominator: twice the volume of the triangle and the eye, positive if
// the triangle winds left. `wide` marks triangles whose plane is near the eye, compared with their
// corners: their D or denominator is a small difference of large numbers.
static inline void key_function(const image_space *s, block corners[3][4], block key[3],
                                block *side, block_mask *wide)
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
#if LOCAL_RAYS
    const block terms = fabs(nx * corners[0][0]) + fabs(ny * corners[0][1]) +
                        fabs(nz) * (fabs(corners[0][2]) + s->offset);
    *wide = !(SMALLER(fabs(*side), fabs(d)) * LARGE_TRIANGLE > terms);
#endif
}

// A bound of the rounding errors: they grow with the triangles' edges and positions in the tile.
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

// The groups that the bounds of triangles reach, as bits. If a pixel sees a triangle, the
// triangle's stored corners lie on both sides of the pixel or on it (covers_exactly). So bounds
// widened by the rounding of the quotients lose nothing. A triangle with a corner not in front of
// the eye may reach all groups.
static inline block_mask groups_in_bounds(const tile *t, const block places[2], block in_front,
                                          const uchar16 corners[3])
{
    block low[2], high[2];
#pragma unroll
    for (int i = 0; i < 2; i++) {
        block a = permute_block(places[i], corners[0]), b = permute_block(places[i], corners[1]);
        block c = permute_block(places[i], corners[2]);
        const scalar slack = R(16.0) * EPSILON, largest = i == 0 ? t->largest_x : t->largest_y;
        low[i] = SMALLEST3(a, b, c);
        high[i] = LARGEST3(a, b, c);
        low[i] -= (fabs(low[i]) + largest) * slack;
        high[i] += (fabs(high[i]) + largest) * slack;
    }
    block_mask columns = 0, groups = 0;
#pragma unroll
    for (int i = 0; i < TILE_COLUMNS; i++) {
        const scalar center = ((const scalar *)&t->center_x)[i];
        block_mask met =
            (high[0] >= center - GROUP_HALF_X(t)) & (low[0] <= center + GROUP_HALF_X(t));
        columns |= met & (block_mask)(1 << i);
    }
#pragma unroll
    for (int i = 0; i < TILE_ROWS; i++) {
        const scalar center = ((const scalar *)&t->center_y)[i * TILE_COLUMNS];
        block_mask met =
            (high[1] >= center - GROUP_HALF_Y(t)) & (low[1] <= center + GROUP_HALF_Y(t));
        groups |= met & (columns << (i * TILE_COLUMNS));
    }
    return SELECT(in_front > R(0.0), groups, (block_mask)((1 << TILE_GROUPS) - 1));
}

// Computes the functions of a cluster's triangles. Returns the triangles that the tile may see, as
// bits.
static inline uint make_image_triangles(const image_space *s, const tile *t,
                                        global const float *cluster, const block vertices[4],
                                        image_triangles *out)
{
    global const uchar *indices = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
    const uchar16 lanes[3] = {vload16(0, indices), vload16(1, indices), vload16(2, indices)};
    // Gather the corners of the triangles, and the largest key of each.
    block corners[3][4];
    block_mask in_front = vertices[3] > R(0.0);
    block inverse = R(1.0) / SELECT(in_front, vertices[3], block_of(1));
    block keys = SELECT(in_front, image_key(s, vertices[2], inverse), block_of(HUGE));
    out->key_largest = -HUGE;
#pragma unroll
    for (int k = 0; k < 3; k++) {
#pragma unroll
        for (int r = 0; r < 4; r++) {
            corners[k][r] = permute_block(vertices[r], lanes[k]);
        }
        block key = permute_block(keys, lanes[k]);
        out->key_largest = LARGER(key, out->key_largest);
    }
    // Cull triangles whose bounds reach no group, or that lie behind all hits.
    if (TILE_GROUPS > 1) {
        const block places[2] = {vertices[0] * inverse, vertices[1] * inverse};
        block least_h = SMALLEST3(corners[0][3], corners[1][3], corners[2][3]);
        out->groups = groups_in_bounds(t, places, least_h, lanes);
        if (block_bits((out->groups != 0) & (out->key_largest >= t->least)) == 0) {
            return 0;
        }
    }
    block side, largest_h;
    block_mask wide = 0;
    key_function(s, corners, out->key, &side, &wide);
    block bound = rounding_bound(t, corners, &largest_h);
    // A triangle seen (nearly) edge-on may wind either way: none of its signs is certain.
    block_mask edge_on = !(fabs(side) > R(2.0) * largest_h * bound);
    out->uncertain = SELECT(edge_on, block_of(HUGE), bound);

    // Cull triangles that lie outside the tile beyond one of their edges.
    block_mask seen = block_of(count_of_cluster(cluster)) > BLOCK_LANES;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        block *edge = out->edges[k];
        edge_function(corners[(k + 1) % 3], corners[(k + 2) % 3], edge);
#pragma unroll
        for (int i = 0; i < 3; i++) {
            edge[i] = SELECT(side < R(0.0), -edge[i], edge[i]);
        }
        block ax = fabs(edge[0]), ay = fabs(edge[1]);
        block middle =
            fused(edge[0], block_of(t->middle_x), fused(edge[1], block_of(t->middle_y), edge[2]));
        block rise = fused(ax, block_of(TILE_HALF_X(t)),
                           fused(ay, block_of(TILE_HALF_Y(t)), out->uncertain));
        seen &= middle >= -rise;
        out->reach[k] = fused(ax, block_of(GROUP_HALF_X(t)),
                              fused(ay, block_of(GROUP_HALF_Y(t)), out->uncertain));
    }
    // Cull triangles whose key is below the keys of all hits.
    block ax = fabs(out->key[0]), ay = fabs(out->key[1]);
    block error =
        (fused(ax, block_of(t->largest_x), fused(ay, block_of(t->largest_y), fabs(out->key[2])))) *
        (R(8.0) * EPSILON);
#if LOCAL_RAYS
    if (HAS_IN(s->frame, LOCAL_ORIGINS)) {
        error = SELECT(wide, block_of(HUGE), error);
        out->wide = wide;
    }
#endif
    block middle = fused(out->key[0], block_of(t->middle_x),
                         fused(out->key[1], block_of(t->middle_y), out->key[2]));
    block highest =
        fused(ax, block_of(TILE_HALF_X(t)), fused(ay, block_of(TILE_HALF_Y(t)), middle + error));
    // A triangle seen exactly edge-on has the key NaN. It culls nothing: no comparison drops it.
    seen &= !(highest < t->least) & !(out->key_largest < t->least);
    out->key_reach =
        fused(ax, block_of(GROUP_HALF_X(t)), fused(ay, block_of(GROUP_HALF_Y(t)), error));
    return TILE_GROUPS > 1 ? block_bits(seen & (out->groups != 0)) : block_bits(seen);
}

// The groups of the tile that a triangle may cover, and in which it may be nearer than the hits so
// far.
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
    met &= !(at + OF(triangles->key_reach) < t->farthest) &
           (OF(triangles->key_largest) >= t->farthest);
    return block_bits(met);
#undef OF
}

// ---- Pixels ------------------------------------------------------------------------------------

// A triangle's corners [corner][x, y, z, h], either the same for all pixels or one per pixel.
typedef struct image_corners {
    real at[3][4];
} image_corners;

// The corners as seen by the pixels at (x, y): x and y of each, relative to the ray.
static inline void corners_about_ray(const image_corners *c, real x, real y, real across[3],
                                     real up[3])
{
#pragma unroll
    for (int k = 0; k < 3; k++) {
        across[k] = fused(-x, c->at[k][3], c->at[k][0]);
        up[k] = fused(-y, c->at[k][3], c->at[k][1]);
    }
}

// The signs of the weights say if the ray passes through the triangle. Divided by their sum they
// are the barycentric weights. Not fused: see intersect.cl.
static inline void weigh_corners(const real x[3], const real y[3], real weights[3])
{
    weights[0] = x[1] * y[2] - y[1] * x[2];
    weights[1] = x[2] * y[0] - y[2] * x[0];
    weights[2] = x[0] * y[1] - y[0] * x[1];
}

// The weights of the corners of visible triangles.
static inline void image_weights(const image_corners *c, real x, real y, mask seen, real weights[3])
{
    real across[3], up[3];
    corners_about_ray(c, x, y, across, up);
    weigh_corners(across, up, weights);
    refine_weights(across, up, seen, weights);
}

// The slow, exact test for pixels where an edge's function is too close to 0.
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
    real cx[3], cy[3], weights[3];
    corners_about_ray(&c, x, y, cx, cy);
    weigh_corners(cx, cy, weights);
    const real u = weights[0], v = weights[1], w = weights[2];
    mask inside = ((u >= R(0.0)) & (v >= R(0.0)) & (w >= R(0.0))) |
                  ((u <= R(0.0)) & (v <= R(0.0)) & (w <= R(0.0)));
    return inside & (u + v + w != R(0.0)) & (SMALLEST3(cx[0], cx[1], cx[2]) <= R(0.0)) &
           (LARGEST3(cx[0], cx[1], cx[2]) >= R(0.0)) & (SMALLEST3(cy[0], cy[1], cy[2]) <= R(0.0)) &
           (LARGEST3(cy[0], cy[1], cy[2]) >= R(0.0));
}

#if LOCAL_RAYS
// The keys of a wide triangle for pixels at (x, y). The plane through its corners has the digits that
// the affine function has lost. `key` is the function's value.
static inline real key_on_plane(const image_space *s, const block vertices[4],
                                global const float *cluster, int i, real x, real y, real key)
{
    global const uchar *indices = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
    float at[9];
    load_triangle(cluster, i, at);
    real3 low;
    const real3 o = begin_at_eye(s->frame, x, y, &low), d = primary_directions(s->frame, x, y);
    const real origin[3] = {o.x, o.y, o.z}, origin_low[3] = {low.x, low.y, low.z};
    const real direction[3] = {d.x, d.y, d.z};
    real corners[9], anchor[3];
    scalar depths[3];
#pragma unroll
    for (int k = 0; k < 9; k++) {
        corners[k] = real_of(at[k]);
    }
#pragma unroll
    for (int k = 0; k < 3; k++) {
        anchor[k] = real_of(FROM_SCENE(cluster, k, R(0.0)));
        depths[k] = ((const scalar *)&vertices[2])[indices[k * GLINT_CLUSTER_LANES + i]];
    }
    const real z = depth_of_plane(corners, anchor, origin, origin_low, direction);
    const mask within = (z >= SMALLEST3(depths[0], depths[1], depths[2])) &
                        (z <= LARGEST3(depths[0], depths[1], depths[2]));
    const real h = fused(real_of(s->slope), z, real_of(s->offset));
    return SELECT(within, (s->key_one - s->key_depth * z) / h, key);
}
#endif

// Tests triangle i of a cluster against the pixels of one group; true if any sees it.
static inline bool meet_group(const image_space *s, tile *t, const image_triangles *triangles,
                              const block vertices[4], global const float *cluster,
                              global const int *numbers, int cluster_index, int i, int g)
{
#define OF(values) real_of(((const scalar *)&(values))[i])
    real x = t->x[g % TILE_COLUMNS], y = t->y[g / TILE_COLUMNS];
    const block(*edges)[3] = triangles->edges;
    real e0 = fused(OF(edges[0][0]), x, fused(OF(edges[0][1]), y, OF(edges[0][2])));
    real e1 = fused(OF(edges[1][0]), x, fused(OF(edges[1][1]), y, OF(edges[1][2])));
    real e2 = fused(OF(edges[2][0]), x, fused(OF(edges[2][1]), y, OF(edges[2][2])));
    real key =
        fused(OF(triangles->key[0]), x, fused(OF(triangles->key[1]), y, OF(triangles->key[2])));
    real least = SMALLER(e0, e1);
    least = SMALLER(least, e2);
    real uncertain = OF(triangles->uncertain);
#if LOCAL_RAYS
    if (HAS_IN(s->frame, LOCAL_ORIGINS) && ((const lane_int *)&triangles->wide)[i] &&
        any_lane(least >= -uncertain)) {
        key = key_on_plane(s, vertices, cluster, i, x, y, key);
    }
#endif
    // Never nearer than the nearest corner, in spite of rounding: culling relies on it.
    key = SMALLER(key, OF(triangles->key_largest));
    mask seen = (least >= -uncertain) & (key >= t->key[g]);
    if (!any_lane(seen)) {
        return false;
    }
    if (((const scalar *)&triangles->key_largest)[i] > s->key_limit) {
        seen &= key <= s->key_limit; // surfaces behind the start are not visible
    }
    if (any_lane(seen & (least <= uncertain))) {
        seen &= (least > uncertain) | covers_exactly(vertices, cluster, i, x, y);
    }
    // Keep the nearer hit, or on a tie the lower number.
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

// Updates the depth beyond which the tile sees nothing, from the least key.
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

// A triangle in at most this many groups is tested without further culling.
#define FEW_GROUPS 2

static inline void meet_cluster(const image_space *s, tile *t, const scene_buffers *scene,
                                int index)
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
        uint groups = 1;
        if (TILE_GROUPS > 1) {
            groups = (uint)((const lane_int *)&triangles.groups)[i];
            if (popcount(groups) > FEW_GROUPS) {
                groups &= groups_of(t, &triangles, i);
            }
        }
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
            size =
                push_waiting(scene, stack, base, size, next.child, child, ((scalar *)&near)[child]);
        }
    }
}

// The corners of a triangle in image coordinates.
static inline image_corners corners_in_image(const image_space *s, const triangle *t)
{
    const real3 *vertices = t->vertices;
    image_corners c;
    real3 origin = real3_of(real_of(s->origin[0]), real_of(s->origin[1]), real_of(s->origin[2]));
#if GLINT_LOCAL_ORIGINS
    origin = subtract(origin, t->anchor);
#if LOCAL_RAYS
    origin = add(origin, real3_of(real_of(s->origin_low[0]), real_of(s->origin_low[1]),
                                  real_of(s->origin_low[2])));
#endif
#endif
#pragma unroll
    for (int k = 0; k < 3; k++) {
        real dx = vertices[k].x - origin.x, dy = vertices[k].y - origin.y;
        real dz = vertices[k].z - origin.z;
#pragma unroll
        for (int r = 0; r < 3; r++) {
            c.at[k][r] = fused(real_of(s->rows[r][0]), dx,
                               fused(real_of(s->rows[r][1]), dy, s->rows[r][2] * dz));
        }
        c.at[k][3] = fused(real_of(s->slope), c.at[k][2], real_of(s->offset));
    }
    return c;
}

// Distances and barycentric weights of the hits on triangles `t`, for pixels at (x, y). `length` is
// the length of the rays' directions before normalisation.
static inline void measure_hits(const image_space *s, const triangle *t, real x, real y,
                                real length, mask met, closest *hit)
{
    const image_corners c = corners_in_image(s, t);
    real weights[3];
    image_weights(&c, x, y, met, weights);
    real inverse = R(1.0) / SELECT(met, weights[0] + weights[1] + weights[2], real_of(1));
    real z = fused(weights[0], c.at[0][2], fused(weights[1], c.at[1][2], weights[2] * c.at[2][2])) *
             inverse;
    hit->t = SELECT(met, z * length, real_of(HUGE));
    hit->b1 = weights[1] * inverse;
    hit->b2 = weights[2] * inverse;
}
