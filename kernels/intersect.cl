// Tests of the packet's rays against boxes and triangles.
//
// A triangle is tested as Woop, Benthin and Wald do (Watertight Ray/Triangle Intersection, 2013): in
// a space sheared so that the ray is its third axis, the signs of three two-dimensional cross
// products decide. Vertices are mapped alike for every triangle that shares them, the products are
// rounded separately (no fused multiply-add: rounding is monotonic, so the sign of a difference of
// rounded products is never wrong, it can only become 0), and 0 counts as inside: no ray passes
// between two triangles that share an edge or a vertex.

// What the tests need of the rays beside origin and direction.
typedef struct packet {
    real origin[3];
    real inverse[3];  // 1/direction, finite
    lanes_int axis;   // the direction's largest component: the third axis of the sheared space
    real shear_x, shear_y, shear_z;
    int axes;         // bit k: some active ray has axis k
    // Per coordinate, over the active rays: whether all directions have the same sign (0: no), and
    // the range of origins and inverses after turning negative directions around.
    int sign[3];
    scalar origin_low[3], origin_high[3];
    scalar inverse_low[3], inverse_high[3];
} packet;

typedef struct closest {
    real t;          // in lengths of the direction; HUGE where nothing was hit
    real b1, b2;     // barycentric weights of the second and third vertex
    lanes_int place; // of the triangle hit, −1: none
    lanes_int triangle; // its number in the scene
} closest;

// The far distance is widened by this much, so that rounding never loses a box that is touched (Ize,
// Robust BVH Ray Traversal, 2013): on either side a difference, a product and a division, and OpenCL
// lets a division be wrong by 2.5 units in the last place, five times EPSILON.
#define FAR_SLACK (R(1.0) + R(16.0) * EPSILON)

// 1/d, kept finite so that 0 times it is 0 and not NaN: a ray along a box's face is inside it.
static inline real finite_inverse(real d)
{
    const real smallest = real_of(R(1.0) / HUGE);
    real magnitude = LARGER(fabs(d), smallest);
    return copysign(R(1.0) / magnitude, d);
}

static inline packet make_packet(real3 origin, real3 direction, mask active)
{
    packet p;
    p.origin[0] = origin.x;
    p.origin[1] = origin.y;
    p.origin[2] = origin.z;
    real d[3] = {direction.x, direction.y, direction.z};
#pragma unroll
    for (int k = 0; k < 3; k++) {
        p.inverse[k] = finite_inverse(d[k]);
        // Rays that are not active must not widen the ranges.
        mask positive = active & (p.inverse[k] > R(0.0));
        mask negative = active & (p.inverse[k] < R(0.0));
        bool any_positive = any_lane(positive), any_negative = any_lane(negative);
        p.sign[k] = any_positive && any_negative ? 0 : any_negative ? -1 : 1;
        scalar turn = p.sign[k] < 0 ? R(-1.0) : R(1.0);
        real o = p.origin[k] * turn, i = p.inverse[k] * turn;
        p.origin_low[k] = smallest_lane(SELECT(active, o, real_of(HUGE)));
        p.origin_high[k] = largest_lane(SELECT(active, o, real_of(-HUGE)));
        p.inverse_low[k] = smallest_lane(SELECT(active, i, real_of(HUGE)));
        p.inverse_high[k] = largest_lane(SELECT(active, i, real_of(-HUGE)));
    }
    real ax = fabs(d[0]), ay = fabs(d[1]), az = fabs(d[2]);
    mask x_major = (ax >= ay) & (ax >= az);
    mask y_major = !x_major & (ay >= az);
    p.axis = SELECT(x_major, int_of(0), SELECT(y_major, int_of(1), int_of(2)));
    // The two other components follow cyclically: y z, z x, x y.
    real along = SELECT(x_major, d[0], SELECT(y_major, d[1], d[2]));
    real first = SELECT(x_major, d[1], SELECT(y_major, d[2], d[0]));
    real second = SELECT(x_major, d[2], SELECT(y_major, d[0], d[1]));
    p.shear_x = first / along;
    p.shear_y = second / along;
    p.shear_z = R(1.0) / along;
    p.axes = (any_lane(active & x_major) ? 1 : 0) | (any_lane(active & y_major) ? 2 : 0) |
             (any_lane(active & !x_major & !y_major) ? 4 : 0);
    return p;
}

// The nearest distance at which any ray of the packet may enter each of a node's boxes, in `entry`;
// bit c of the result is set if some ray may meet box c before `farthest`. By interval arithmetic
// over the packet, so a set bit may be wrong for a wide packet; a clear bit never is.
static inline uint packet_meets_boxes(const packet *p, global const float *node, scalar farthest,
                                      boxes *entry)
{
    boxes near = 0, far = HUGE;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        if (p->sign[k] == 0) {
            continue;
        }
        boxes low = load_boxes(node + k * GLINT_BVH_WIDTH);
        boxes high = load_boxes(node + (3 + k) * GLINT_BVH_WIDTH);
        if (p->sign[k] < 0) {
            boxes turned = -low;
            low = -high;
            high = turned;
        }
        boxes to_low = low - p->origin_high[k], to_high = high - p->origin_low[k];
        boxes near_k = to_low * (to_low > (boxes)0 ? (boxes)p->inverse_low[k]
                                                   : (boxes)p->inverse_high[k]);
        boxes far_k = to_high * (to_high > (boxes)0 ? (boxes)p->inverse_high[k]
                                                    : (boxes)p->inverse_low[k]);
        near = LARGER(near_k, near);
        far = SMALLER(far_k, far);
    }
    *entry = near;
    boxes_mask met = (near <= far * FAR_SLACK) & (near <= farthest);
    return box_bits(met);
}

#if GLINT_WIDTH > 1
// The rays that may meet one box before what they have hit so far.
static inline mask rays_meet_box(const packet *p, global const float *node, int child, real farthest)
{
    real near = real_of(0), far = farthest;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        scalar low = node[k * GLINT_BVH_WIDTH + child];
        scalar high = node[(3 + k) * GLINT_BVH_WIDTH + child];
        real to_low = (low - p->origin[k]) * p->inverse[k];
        real to_high = (high - p->origin[k]) * p->inverse[k];
        real near_k = SMALLER(to_low, to_high), far_k = LARGER(to_low, to_high);
        near = LARGER(near_k, near);
        far = SMALLER(far_k, far);
    }
    return near <= far * FAR_SLACK;
}
#endif

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

// Tests one triangle against the rays in `active` and keeps the nearer hit. At equal distance the
// triangle with the lower number in the scene wins, whatever the order of the tests.
static inline void intersect_triangle(const packet *p, const float vertices[9], int place,
                                      int triangle, mask active, closest *hit)
{
#pragma unroll
    for (int k = 0; k < 3; k++) {
        if (!(p->axes & (1 << k))) {
            continue;
        }
        const int x = (k + 1) % 3, y = (k + 2) % 3, z = k;
        // Vertices relative to the origin, sheared.
        real az = vertices[z] - p->origin[z], bz = vertices[3 + z] - p->origin[z];
        real cz = vertices[6 + z] - p->origin[z];
        real ax = fused(-p->shear_x, az, vertices[x] - p->origin[x]);
        real ay = fused(-p->shear_y, az, vertices[y] - p->origin[y]);
        real bx = fused(-p->shear_x, bz, vertices[3 + x] - p->origin[x]);
        real by = fused(-p->shear_y, bz, vertices[3 + y] - p->origin[y]);
        real cx = fused(-p->shear_x, cz, vertices[6 + x] - p->origin[x]);
        real cy = fused(-p->shear_y, cz, vertices[6 + y] - p->origin[y]);
        // Twice the areas that the ray cuts off, on either side of it. Not fused: see above.
        real u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
        mask inside = ((u >= R(0.0)) & (v >= R(0.0)) & (w >= R(0.0))) |
                      ((u <= R(0.0)) & (v <= R(0.0)) & (w <= R(0.0)));
        real determinant = u + v + w;
        inside = inside & active & (determinant != R(0.0)) & (p->axis == (lane_int)k);
        if (!any_lane(inside)) {
            continue;
        }
        real inverse = R(1.0) / SELECT(inside, determinant, real_of(1));
        real t = fused(u, az, fused(v, bz, w * cz)) * p->shear_z * inverse;
        mask nearer = (t < hit->t) | ((t == hit->t) & (hit->triangle > (lane_int)triangle));
        mask taken = inside & (t > R(0.0)) & nearer;
        hit->t = SELECT(taken, t, hit->t);
        hit->b1 = SELECT(taken, v * inverse, hit->b1);
        hit->b2 = SELECT(taken, w * inverse, hit->b2);
        hit->place = SELECT(taken, int_of(place), hit->place);
        hit->triangle = SELECT(taken, int_of(triangle), hit->triangle);
    }
}

// The same test of one ray against all triangles of a cluster, which stand from place `first` on:
// operation by operation that of intersect_triangle, so that both find the same.
static inline void intersect_by_ray(const packet *p, int ray, global const float *cluster,
                                    global const int *numbers, int first, int count, int from,
                                    closest *hit)
{
    const int z = (int)LANE_INT(p->axis, ray), x = (z + 1) % 3, y = (z + 2) % 3;
    const block shear_x = block_of(-LANE(p->shear_x, ray)), shear_y = block_of(-LANE(p->shear_y, ray));
    // Vertices relative to the origin, sheared, and then those of each corner.
    block depth = load_block(cluster + z * GLINT_CLUSTER_LANES) - LANE(p->origin[z], ray);
    block across = fused(shear_x, depth, load_block(cluster + x * GLINT_CLUSTER_LANES) -
                                             LANE(p->origin[x], ray));
    block up = fused(shear_y, depth, load_block(cluster + y * GLINT_CLUSTER_LANES) -
                                         LANE(p->origin[y], ray));
    global const uchar *corners = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
    block cx[3], cy[3], cz[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        uchar16 lanes = vload16(k, corners);
        cx[k] = permute_block(across, lanes);
        cy[k] = permute_block(up, lanes);
        cz[k] = permute_block(depth, lanes);
    }
    block u = cx[2] * cy[1] - cy[2] * cx[1], v = cx[0] * cy[2] - cy[0] * cx[2];
    block w = cx[1] * cy[0] - cy[1] * cx[0];
    block_mask inside = ((u >= R(0.0)) & (v >= R(0.0)) & (w >= R(0.0))) |
                        ((u <= R(0.0)) & (v <= R(0.0)) & (w <= R(0.0)));
    block determinant = u + v + w;
    inside &= (determinant != R(0.0)) & (BLOCK_LANES < (scalar)count) &
              (BLOCK_LANES != (scalar)(from - first));
    if (block_bits(inside) == 0) {
        return;
    }
    block inverse = R(1.0) / SELECT(inside, determinant, block_of(1));
    block t = fused(u, cz[0], fused(v, cz[1], w * cz[2])) * LANE(p->shear_z, ray) * inverse;
    t = SELECT(inside & (t > R(0.0)) & (t <= LANE(hit->t, ray)), t, block_of(HUGE));
    scalar nearest = smallest_of_16(t);
    uint found = nearest < HUGE ? block_bits(t == nearest) : 0;
    while (found != 0) {
        int i = lowest_bit(found);
        found &= found - 1;
        int number = numbers[first + i];
        if (nearest < LANE(hit->t, ray) || number < (int)LANE_INT(hit->triangle, ray)) {
            LANE(hit->t, ray) = nearest;
            LANE(hit->b1, ray) = ((scalar *)&v)[i] * ((scalar *)&inverse)[i];
            LANE(hit->b2, ray) = ((scalar *)&w)[i] * ((scalar *)&inverse)[i];
            LANE_INT(hit->place, ray) = first + i;
            LANE_INT(hit->triangle, ray) = number;
        }
    }
}
