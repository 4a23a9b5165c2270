// Tests the packet's rays against boxes and triangles.
//
// The watertight triangle test follows Woop, Benthin and Wald (Watertight Ray/Triangle
// Intersection, 2013). It shears space so that the ray becomes the third axis. Then the signs of
// three two-dimensional cross products decide. No ray passes between two triangles that share an
// edge or a vertex, for three reasons:
//   - A shared vertex is mapped in the same way for each of its triangles.
//   - The products are rounded separately, without a fused multiply-add. Rounding is monotonic, so
//     the sign of a difference of rounded products is never wrong; it can only become 0.
//   - 0 counts as inside.
// A product may be 0 only by rounding, as for a distant triangle seen edge-on. So if a product is
// 0, the ray must also pass within the bounds of the triangle's corners.
//
// After a hit the same products are computed again without cancellation, for the barycentric
// weights. Otherwise the weights of a sliver, and the position of the hit, would have no correct
// digit.

// The data of the rays that the tests need.
typedef struct packet {
    real origin[3];
#if LOCAL_RAYS
    real origin_low[3]; // the low parts of the origins
#endif
    real direction[3];
    lanes_int axis; // the direction's largest component: the third axis of the sheared space
    real shear_x, shear_y, shear_z;
    real inverse[3]; // 1/direction, finite
} packet;

typedef struct closest {
    real t;          // in lengths of the direction; HUGE: no hit
    real b1, b2;     // barycentric weights of the second and third vertex
    lanes_int place; // of the triangle hit, −1: none
} closest;           // of the triangle hit; −1: none

// Widens the far distance, so that rounding never loses a box that the ray touches (Ize, Robust BVH
// Ray Traversal, 2013). Each side has a difference, a product and a division. OpenCL allows an
// error of 2.5 units in the last place in a division, five times EPSILON.
#define FAR_SLACK (R(1.0) + R(16.0) * EPSILON)

// 1/d, kept finite so that 0 times it is 0 and not NaN. So a ray along a box's face is inside the
// box.
static inline real finite_inverse(real d)
{
    const real smallest = real_of(R(1.0) / HUGE);
    real magnitude = LARGER(fabs(d), smallest);
    return copysign(R(1.0) / magnitude, d);
}

// Leaves origin_low unset. packet_of_paths, which makes the packets for tracing, also sets it.
static inline packet make_packet(real3 origin, real3 direction)
{
    packet p;
    p.origin[0] = origin.x;
    p.origin[1] = origin.y;
    p.origin[2] = origin.z;
    p.direction[0] = direction.x;
    p.direction[1] = direction.y;
    p.direction[2] = direction.z;
    const real *d = p.direction;
    mask x_major, y_major;
    find_major(direction, &x_major, &y_major);
    p.axis = SELECT(x_major, int_of(0), SELECT(y_major, int_of(1), int_of(2)));
    // The two other components follow cyclically: y z, z x, x y.
    real along = SELECT(x_major, d[0], SELECT(y_major, d[1], d[2]));
    real first = SELECT(x_major, d[1], SELECT(y_major, d[2], d[0]));
    real second = SELECT(x_major, d[2], SELECT(y_major, d[0], d[1]));
    p.shear_z = R(1.0) / along;
    p.shear_x = first * p.shear_z;
    p.shear_y = second * p.shear_z;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        p.inverse[k] = finite_inverse(p.direction[k]);
    }
    return p;
}

// The rays that may meet one box before their nearest hit so far.
static inline mask rays_meet_box(const packet *p, global const float *node, int child,
                                 real farthest)
{
    real near = real_of(0), far = farthest;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        scalar low = node[k * GLINT_BVH_WIDTH + child] - FRUSTUM_SLACK;
        scalar high = node[(3 + k) * GLINT_BVH_WIDTH + child] + FRUSTUM_SLACK;
        real to_low = (low - p->origin[k]) * p->inverse[k];
        real to_high = (high - p->origin[k]) * p->inverse[k];
        real near_k = SMALLER(to_low, to_high), far_k = LARGER(to_low, to_high);
        near = LARGER(near_k, near);
        far = SMALLER(far_k, far);
    }
    return near <= far * FAR_SLACK;
}

// A cluster, the place `first` of its first triangle, and the numbers of all triangles.
typedef struct leaf {
    const scene_buffers *scene;
    global const float *cluster;
    int first;
} leaf;

static inline leaf leaf_at(const scene_buffers *scene, int index)
{
    const leaf l = {scene, scene->clusters + (size_t)index * GLINT_CLUSTER_VALUES,
                    index * GLINT_CLUSTER_LANES};
    return l;
}

// The rays' origins, relative to the anchor of a leaf's vertices. With LOCAL_ORIGINS `room` holds
// the result.
static inline const real *origins_at_leaf(const packet *p, const leaf *leaf, real room[3])
{
#if GLINT_LOCAL_ORIGINS
#pragma unroll
    for (int k = 0; k < 3; k++) {
        room[k] = FROM_ANCHOR(leaf->cluster, k, p->origin[k]);
#if LOCAL_RAYS
        room[k] += p->origin_low[k];
#endif
    }
    return room;
#else
    return p->origin;
#endif
}

// Reads the three vertices, x y z each, of the triangle in one lane of a cluster.
static inline void load_triangle(global const float *cluster, int lane, float vertices[9])
{
    global const uchar *corners = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
#pragma unroll
    for (int i = 0; i < 3; i++) {
        int vertex = corners[i * GLINT_CLUSTER_LANES + lane];
#pragma unroll
        for (int k = 0; k < 3; k++) {
            vertices[3 * i + k] = cluster[k * GLINT_CLUSTER_LANES + vertex];
        }
    }
}

// Of two triangles at the same distance, the triangle with the lower number in the scene is
// visible, for every order of tests. Returns the rays for which `place` wins over `other`.
static inline mask has_lower_number(global const int *numbers, int place, lanes_int other,
                                    mask wanted)
{
    lanes_int lower = int_of(0);
    for (uint left = mask_bits(wanted); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left), rival = (int)LANE_INT(other, lane);
        LANE_INT(lower, lane) = rival < 0 || numbers[place] < numbers[rival];
    }
    return lower != (lane_int)0;
}

// A triangle whose area is this much smaller than its bounding box gets refined weights. The
// weights of other triangles lose at most four digits.
#define SLIVER R(0.0625)

// Recomputes the weights of slivers as precisely as the corners allow. The corners are at (x, y);
// the triangle holds (0, 0), so all weights are ≥ 0 or all are ≤ 0. The refined weights may show
// that (0, 0) lies beside the triangle, and that only rounding had put it inside. Then the nearest
// point of that edge counts. So weights stay within [0, 1], and distances within the tested box.
static inline void refine_weights(const real x[3], const real y[3], mask wanted, real weights[3])
{
    const real width = LARGEST3(fabs(x[0]), fabs(x[1]), fabs(x[2]));
    const real height = LARGEST3(fabs(y[0]), fabs(y[1]), fabs(y[2]));
    const real area = fabs(weights[0] + weights[1] + weights[2]);
    const mask slivers = wanted & (area < SLIVER * (width * height));
    if (!any_lane(slivers)) {
        return;
    }
    // Compute the weights again without cancellation.
    real refined[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        refined[k] = DIFFERENCE_OF_PRODUCTS(x[i], y[j], y[i], x[j]);
    }
    const real sum = refined[0] + refined[1] + refined[2], zero = real_of(0), one = real_of(1);
    const real sign = SELECT(sum > R(0.0), one, -one);
    const real least = sign * SELECT(sum > R(0.0), SMALLEST3(refined[0], refined[1], refined[2]),
                                     LARGEST3(refined[0], refined[1], refined[2]));
    const mask inside = slivers & (sum != R(0.0)) & (least >= R(0.0));
    const mask beside = slivers & (sum != R(0.0)) & (least < R(0.0));
#pragma unroll
    for (int k = 0; k < 3; k++) {
        weights[k] = SELECT(inside, refined[k], weights[k]);
    }
    // Beside the triangle: take the nearest point of the edge.
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const real along_x = x[j] - x[i], along_y = y[j] - y[i];
        const real squared = fused(along_x, along_x, along_y * along_y);
        const real reach = -fused(x[i], along_x, y[i] * along_y);
        // An edge without length is its first corner; NaN compares false.
        const real share = SELECT(reach > R(0.0), SMALLER(reach / squared, one), zero);
        const mask here = beside & (sign * refined[k] == least);
        weights[i] = SELECT(here, one - share, weights[i]);
        weights[j] = SELECT(here, share, weights[j]);
        weights[k] = SELECT(here, zero, weights[k]);
    }
}

// Distance from a triangle's plane at which rays start that leave the triangle. It is a factor of
// the vertices' distances from the origin of coordinates, along the plane's normal;
// place_on_triangle gives the reason. With LOCAL_ORIGINS the origin is the cluster's, and the start
// needs two more roundings.
#define START_OFFSET(scene) (HAS_IN(scene, LOCAL_ORIGINS) ? R(12.0) * EPSILON : R(8.0) * EPSILON)

// True if three points lie in the plane of a triangle. The tolerance is the distance from the plane
// at which rays start (place_on_triangle).
static inline bool lie_in_plane(const scene_buffers *scene, const float own[9],
                                const scalar corners[9])
{
    scalar a[3], b[3], farthest = R(0.0), off[3] = {R(0.0), R(0.0), R(0.0)};
#pragma unroll
    for (int k = 0; k < 3; k++) {
        a[k] = (scalar)own[3 + k] - (scalar)own[k];
        b[k] = (scalar)own[6 + k] - (scalar)own[k];
    }
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const scalar n = a[i] * b[j] - a[j] * b[i];
        farthest += fabs(n) * LARGEST3(fabs((scalar)own[k]), fabs((scalar)own[3 + k]),
                                       fabs((scalar)own[6 + k]));
#pragma unroll
        for (int v = 0; v < 3; v++) {
            off[v] = fused(n, corners[3 * v + k] - (scalar)own[k], off[v]);
        }
    }
    return LARGEST3(fabs(off[0]), fabs(off[1]), fabs(off[2])) <= START_OFFSET(scene) * farthest;
}

// True if a triangle lies in the plane of the triangle at place `start`; −1: none.
static inline bool lies_in_plane_of(const leaf *leaf, int start, const float corners[9])
{
    if (start < 0) {
        return false;
    }
    const int cluster = start / GLINT_CLUSTER_LANES - leaf->first / GLINT_CLUSTER_LANES;
    global const float *from = leaf->cluster + (long)cluster * GLINT_CLUSTER_VALUES;
    float own[9];
    scalar told[9];
    load_triangle(from, start % GLINT_CLUSTER_LANES, own);
    for (int k = 0; k < 9; k++) {
        told[k] = FROM_ANCHOR(from, k % 3, FROM_SCENE(leaf->cluster, k % 3, R(0.0))) + corners[k];
    }
    return lie_in_plane(leaf->scene, own, told);
}

// A ray that leaves a plane meets no triangle in that plane. But rounding may report a hit if the
// ray starts exactly in the plane, for example in a plane through the origin of coordinates at
// right angles to an axis. The false hit has a depth of about 8u of the farthest corner's depth,
// over the cosine to the normal. For cosines down to 10⁻⁴ this is less than the share below.
#define NEXT_TO_NOTHING R(0.00390625)

// False for rays among `rays` that start in the plane of the triangle; true for all others.
static inline mask start_off_plane(const leaf *leaf, lanes_int from, const float corners[9],
                                   mask rays)
{
    lanes_int start = int_of(0);
    for (uint left = mask_bits(rays); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        LANE_INT(start, lane) = lies_in_plane_of(leaf, (int)LANE_INT(from, lane), corners);
    }
    return start == (lane_int)0;
}

#if LOCAL_RAYS
// The distance to a triangle that is large compared with that distance. `depths` are the corners'
// depths along axis z from the rays' origins, and `t` is the distance computed from them.
static inline real distance_nearby(const packet *p, const leaf *leaf, int z, const float corners[9],
                                   const real depths[3], real t)
{
    const int x = z < 2 ? z + 1 : 0, y = z > 0 ? z - 1 : 2;
    real slopes[3], anchor[3], vertices[9];
    slopes[z] = real_of(1);
    slopes[x] = p->shear_x;
    slopes[y] = p->shear_y;
#pragma unroll
    for (int k = 0; k < 9; k++) {
        anchor[k % 3] = real_of(FROM_SCENE(leaf->cluster, k % 3, R(0.0)));
        vertices[k] = real_of(corners[k]);
    }
    const real found = depth_of_plane(vertices, anchor, p->origin, p->origin_low, slopes);
    const mask within = (found >= SMALLEST3(depths[0], depths[1], depths[2])) &
                        (found <= LARGEST3(depths[0], depths[1], depths[2]));
    return SELECT(within, found * p->shear_z, t);
}
#endif

// Tests a leaf's triangle at `place` against the rays in `active` and keeps the nearer hit. The
// rays start on the triangles at the places `from`. `origin` comes from origins_at_leaf.
static inline bool intersect_triangle(const packet *p, const real *origin, int axes,
                                      const leaf *leaf, int place, lanes_int from, mask active,
                                      closest *hit)
{
    bool found = false;
    float vertices[9];
    load_triangle(leaf->cluster, place - leaf->first, vertices);
    active = active & (from != (lane_int)place);
#pragma unroll
    for (int k = 0; k < 3; k++) {
        if (!(axes & (1 << k))) {
            continue;
        }
        const int x = (k + 1) % 3, y = (k + 2) % 3, z = k;
        // Vertices relative to the origin, sheared.
        real az = vertices[z] - origin[z], bz = vertices[3 + z] - origin[z];
        real cz = vertices[6 + z] - origin[z];
        real ax = fused(-p->shear_x, az, vertices[x] - origin[x]);
        real ay = fused(-p->shear_y, az, vertices[y] - origin[y]);
        real bx = fused(-p->shear_x, bz, vertices[3 + x] - origin[x]);
        real by = fused(-p->shear_y, bz, vertices[3 + y] - origin[y]);
        real cx = fused(-p->shear_x, cz, vertices[6 + x] - origin[x]);
        real cy = fused(-p->shear_y, cz, vertices[6 + y] - origin[y]);
        // Twice the signed areas of the three parts into which the ray divides the triangle. Not
        // fused: see the top of the file.
        real u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        real least = SMALLEST3(u, v, w), most = LARGEST3(u, v, w);
        real determinant = u + v + w;
        mask inside = active & ((least >= R(0.0)) | (most <= R(0.0))) & (determinant != R(0.0));
        if (axes != 1 << k) {
            inside = inside & (p->axis == (lane_int)k);
        }
        if (!any_lane(inside)) {
            continue;
        }
        // On an edge, the ray must also pass within the bounds of the corners.
        if (any_lane(inside & ((least == R(0.0)) | (most == R(0.0))))) {
            inside = inside & (SMALLEST3(ax, bx, cx) <= R(0.0)) & (LARGEST3(ax, bx, cx) >= R(0.0)) &
                     (SMALLEST3(ay, by, cy) <= R(0.0)) & (LARGEST3(ay, by, cy) >= R(0.0));
        }
        // Refine the weights and find the distance.
        const real across[3] = {ax, bx, cx}, up[3] = {ay, by, cy};
        real weights[3] = {u, v, w};
        refine_weights(up, across, inside, weights);
        determinant = weights[0] + weights[1] + weights[2];
        real inverse = R(1.0) / SELECT(inside, determinant, real_of(1));
        const real reach = LARGEST3(fabs(az), fabs(bz), fabs(cz)) * fabs(p->shear_z);
        real t =
            fused(weights[0], az, fused(weights[1], bz, weights[2] * cz)) * p->shear_z * inverse;
#if LOCAL_RAYS
        const mask nearby = inside & (LARGE_TRIANGLE * fabs(t) < reach);
        if (HAS_IN(leaf->scene, LOCAL_ORIGINS) && any_lane(nearby)) {
            const real depths[3] = {az, bz, cz};
            t = SELECT(nearby, distance_nearby(p, leaf, z, vertices, depths, t), t);
        }
#endif
        // Keep hits in front of the start; of these the nearest, or on a tie the lower number.
        inside = inside & (t > R(0.0));
        const mask near = inside & (t < NEXT_TO_NOTHING * reach);
        if (any_lane(near)) {
            inside = inside & start_off_plane(leaf, from, vertices, near);
        }
        mask taken = inside & (t < hit->t), tied = inside & (t == hit->t);
        if (any_lane(tied)) {
            taken =
                taken | (tied & has_lower_number(leaf->scene->numbers, place, hit->place, tied));
        }
        found = found || any_lane(taken);
        hit->t = SELECT(taken, t, hit->t);
        hit->b1 = SELECT(taken, weights[1] * inverse, hit->b1);
        hit->b2 = SELECT(taken, weights[2] * inverse, hit->b2);
        hit->place = SELECT(taken, int_of(place), hit->place);
    }
    return found;
}

// One ray of a packet, for tests against many boxes or triangles at once.
typedef struct lone_ray {
    scalar origin[3];
#if LOCAL_RAYS
    scalar origin_low[3];
#endif
    scalar shear_x, shear_y, shear_z;
    int axis, from; // `from`: place of the triangle that the ray starts on; −1: none
} lone_ray;

static inline lone_ray take_ray(const packet *p, int lane, lanes_int from)
{
    lone_ray ray;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        ray.origin[k] = LANE(p->origin[k], lane);
#if LOCAL_RAYS
        ray.origin_low[k] = LANE(p->origin_low[k], lane);
#endif
    }
    ray.shear_x = LANE(p->shear_x, lane);
    ray.shear_y = LANE(p->shear_y, lane);
    ray.shear_z = LANE(p->shear_z, lane);
    ray.axis = (int)LANE_INT(p->axis, lane);
    ray.from = (int)LANE_INT(from, lane);
    return ray;
}

// The ray's origin along axis k, relative to the leaf's anchor, as in origins_at_leaf.
static inline scalar origin_at_leaf(const lone_ray *ray, const leaf *leaf, int k)
{
    scalar origin = FROM_ANCHOR(leaf->cluster, k, ray->origin[k]);
#if LOCAL_RAYS
    origin += ray->origin_low[k];
#endif
    return origin;
}

// One ray against all triangles of a cluster. Bits mark the triangles that the ray is inside of,
// and those where it is on an edge, perhaps only by rounding. u, v and w are as in
// intersect_triangle.
typedef struct cluster_test {
    uint inside, on_edge;
    block u, v, w;
} cluster_test;

// The first half of intersect_triangle, for one ray and all triangles of a cluster, with exactly
// the same operations. It has no branch, so one ray's test does not wait for another's.
static inline void test_cluster(const lone_ray *ray, const leaf *leaf, cluster_test *test)
{
    global const float *cluster = leaf->cluster;
    const int z = ray->axis, x = z < 2 ? z + 1 : 0, y = z > 0 ? z - 1 : 2;
    const int count = count_of_cluster(cluster);
    const scalar ox = origin_at_leaf(ray, leaf, x), oy = origin_at_leaf(ray, leaf, y);
    const block shear_x = block_of(-ray->shear_x), shear_y = block_of(-ray->shear_y);
    // Vertices relative to the origin, sheared. Then permute them to the triangles' corners.
    block depth = load_block(cluster + z * GLINT_CLUSTER_LANES) - origin_at_leaf(ray, leaf, z);
    block across = fused(shear_x, depth, load_block(cluster + x * GLINT_CLUSTER_LANES) - ox);
    block up = fused(shear_y, depth, load_block(cluster + y * GLINT_CLUSTER_LANES) - oy);
    global const uchar *corners = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
    const uchar16 a = vload16(0, corners), b = vload16(1, corners), c = vload16(2, corners);
    block ax = permute_block(across, a), ay = permute_block(up, a);
    block bx = permute_block(across, b), by = permute_block(up, b);
    block cx = permute_block(across, c), cy = permute_block(up, c);
    block u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    block least = SMALLEST3(u, v, w), most = LARGEST3(u, v, w);
    block_mask inside = ((least >= R(0.0)) | (most <= R(0.0))) & (u + v + w != R(0.0)) &
                        (BLOCK_LANES < (scalar)count) &
                        (BLOCK_LANES != (scalar)(ray->from - leaf->first));
    test->inside = block_bits(inside);
    test->on_edge = block_bits(inside & ((least == R(0.0)) | (most == R(0.0))));
    test->u = u;
    test->v = v;
    test->w = w;
}

#if LOCAL_RAYS
// A packet with the data that distance_nearby needs, the same in all lanes.
static inline packet packet_of_lone(const lone_ray *ray)
{
    packet p;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        p.origin[k] = real_of(ray->origin[k]);
        p.origin_low[k] = real_of(ray->origin_low[k]);
    }
    p.shear_x = real_of(ray->shear_x);
    p.shear_y = real_of(ray->shear_y);
    p.shear_z = real_of(ray->shear_z);
    return p;
}
#endif

// The second half, for triangle i. If the ray meets it before its hit so far, in lane `lane` of
// *hit, it becomes the new hit.
static inline bool take_if_nearer(const lone_ray *ray, const leaf *leaf, const cluster_test *test,
                                  int i, closest *hit, int lane)
{
    float at[9];
    load_triangle(leaf->cluster, i, at);
    const int z = ray->axis, x = z < 2 ? z + 1 : 0, y = z > 0 ? z - 1 : 2;
    const scalar ox = origin_at_leaf(ray, leaf, x), oy = origin_at_leaf(ray, leaf, y),
                 oz = origin_at_leaf(ray, leaf, z);
    const scalar az = at[z] - oz, bz = at[3 + z] - oz, cz = at[6 + z] - oz;
    const scalar ax = fused(-ray->shear_x, az, at[x] - ox),
                 ay = fused(-ray->shear_y, az, at[y] - oy),
                 bx = fused(-ray->shear_x, bz, at[3 + x] - ox),
                 by = fused(-ray->shear_y, bz, at[3 + y] - oy),
                 cx = fused(-ray->shear_x, cz, at[6 + x] - ox),
                 cy = fused(-ray->shear_y, cz, at[6 + y] - oy);
    if ((test->on_edge & (1u << i)) &&
        !(SMALLEST3(ax, bx, cx) <= R(0.0) && LARGEST3(ax, bx, cx) >= R(0.0) &&
          SMALLEST3(ay, by, cy) <= R(0.0) && LARGEST3(ay, by, cy) >= R(0.0))) {
        return false;
    }
    // One ray's values in all lanes: the same operations as for a packet.
    const real across[3] = {real_of(ax), real_of(bx), real_of(cx)};
    const real up[3] = {real_of(ay), real_of(by), real_of(cy)};
    real weights[3] = {real_of(((const scalar *)&test->u)[i]),
                       real_of(((const scalar *)&test->v)[i]),
                       real_of(((const scalar *)&test->w)[i])};
    refine_weights(up, across, mask_all(), weights);
    const scalar u = LANE(weights[0], 0), v = LANE(weights[1], 0), w = LANE(weights[2], 0);
    const scalar inverse = R(1.0) / (u + v + w);
    const scalar reach = LARGEST3(fabs(az), fabs(bz), fabs(cz)) * fabs(ray->shear_z);
    scalar t = fused(u, az, fused(v, bz, w * cz)) * ray->shear_z * inverse;
#if LOCAL_RAYS
    if (HAS_IN(leaf->scene, LOCAL_ORIGINS) && LARGE_TRIANGLE * fabs(t) < reach) {
        const real depths[3] = {real_of(az), real_of(bz), real_of(cz)};
        const packet one = packet_of_lone(ray);
        const real nearby = distance_nearby(&one, leaf, z, at, depths, real_of(t));
        t = LANE(nearby, 0);
    }
#endif
    // Keep the nearer hit, or on a tie the lower number.
    const scalar before = LANE(hit->t, lane);
    if (!(t > R(0.0) && t <= before)) {
        return false;
    }
    if (t < NEXT_TO_NOTHING * reach && lies_in_plane_of(leaf, ray->from, at)) {
        return false;
    }
    const int place = leaf->first + i, rival = (int)LANE_INT(hit->place, lane);
    if (t == before && rival >= 0 && leaf->scene->numbers[place] > leaf->scene->numbers[rival]) {
        return false;
    }
    LANE(hit->t, lane) = t;
    LANE(hit->b1, lane) = v * inverse;
    LANE(hit->b2, lane) = w * inverse;
    LANE_INT(hit->place, lane) = place;
    return true;
}

// Compares the triangles that the test found with the ray's hit. True if one of them is nearer.
static inline bool take_nearest(const lone_ray *ray, const leaf *leaf, const cluster_test *test,
                                closest *hit, int lane)
{
    bool found = false;
    for (uint left = test->inside; left != 0; left &= left - 1) {
        found |= take_if_nearer(ray, leaf, test, lowest_bit(left), hit, lane);
    }
    return found;
}
