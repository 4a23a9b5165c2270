// Bounds a packet's rays by a frustum. No ray meets a box or triangle outside of it.
//
// The rays run along one axis; w = sign × that coordinate, u and v are the other two coordinates.
// The least and largest u of all rays, at the first ray's start and at the scene's end, give two
// planes; v gives two more. Rays are straight, so they stay between the planes.
// Rounding, here and in the triangle tests, moves positions by less than FRUSTUM_SLACK. The planes
// are moved outwards by FRUSTUM_SLACK, so they cull no hit that those tests would find. The errors,
// in units of EPSILON, are:
//   - a slope at the far end 30, the planes' slopes 30, their positions 17, their offsets 17
//   - Woop's test 17, or 43 across an axis that is not the ray's largest: 140 in all
// They hold for stored coordinates in [−1, 1], slopes in ±2.5, distances of 2, and divisions off by
// 5 (OpenCL's 2.5 units in the last place).
#define FRUSTUM_SLACK (R(256.0) * EPSILON)
// A ray belongs to the frustum along an axis if the direction's component on this axis is at least
// this part of its largest component.
#define FRUSTUM_ALONG R(0.4)
// The largest stored coordinate; and a distance beyond the scene. Missing children (GLINT_FAR) lie
// beyond both.
#define SCENE_REACH R(1.0)
#define SCENE_END R(4.0)
// Rays whose ends are farther apart do not stay together: each ray may meet little of the boxes
// that their common frustum meets.
#define WIDE R(0.1)
// A frustum around several groups pays off if its cross-section is at most this many times the sum
// of the groups' cross-sections.
#define COMPACT R(3.0)

typedef struct frustum {
    int along;     // the axis
    scalar sign;   // of the directions along it: +1 or −1
    scalar begin;  // the least w of the origins
    real w, speed; // w of the origins, and how fast it rises
    // Bounds of u, then of v: inside is coordinate ≥ offset + slope × the coordinate along the axis
    // for [0], and ≤ for [1].
    scalar slope[2][2], offset[2][2];
    bool wide;
} frustum;

// The two coordinates across an axis follow it cyclically.
static inline int across_axis(int along, int which) { return (along + 1 + which) % 3; }

// The rays of `wanted` that run along the axis in the direction of `sign`.
static inline mask rays_along(const real3 *direction, int along, scalar sign, mask wanted)
{
    real d = along == 0 ? direction->x : along == 1 ? direction->y : direction->z;
    return wanted & (sign * d >= FRUSTUM_ALONG * largest_magnitude3(*direction));
}

static inline frustum make_frustum(const real origin[3], const real direction[3], int along,
                                   scalar sign, mask rays)
{
    frustum f;
    f.along = along;
    f.sign = sign;
    f.w = sign * origin[along];
    f.speed = SELECT(rays, sign * direction[along], real_of(1));
    f.begin = smallest_lane(SELECT(rays, f.w, real_of(SCENE_END)));
    f.wide = false;
    scalar distance = LARGER(SCENE_REACH - f.begin, R(0.0625));
    real inverse = R(1.0) / f.speed;
#pragma unroll
    for (int i = 0; i < 2; i++) {
        const int k = across_axis(along, i);
        real slope = direction[k] * inverse;
        real first = fused(f.begin - f.w, slope, origin[k]);
        real last = fused(real_of(distance), slope, first);
        scalar low = smallest_lane(SELECT(rays, first, real_of(HUGE)));
        scalar high = largest_lane(SELECT(rays, first, real_of(-HUGE)));
        scalar last_low = smallest_lane(SELECT(rays, last, real_of(HUGE)));
        scalar last_high = largest_lane(SELECT(rays, last, real_of(-HUGE)));
        f.wide = f.wide || (GLINT_WIDTH > 1 && last_high - last_low > WIDE);
        scalar least = (last_low - low) / distance, most = (last_high - high) / distance;
        f.offset[i][0] = low - least * f.begin - FRUSTUM_SLACK;
        f.offset[i][1] = high - most * f.begin + FRUSTUM_SLACK;
        f.slope[i][0] = sign * least;
        f.slope[i][1] = sign * most;
    }
    f.begin -= FRUSTUM_SLACK;
    return f;
}

// Sets bit c if box c of the node reaches into the frustum before `farthest`. `near` is the box's
// position along the axis.
static inline uint frustum_meets_boxes(const frustum *f, global const float *node, scalar farthest,
                                       boxes *near)
{
    global const float *low = node, *high = node + 3 * GLINT_BVH_WIDTH;
    global const float *low_w = low + f->along * GLINT_BVH_WIDTH;
    global const float *high_w = high + f->along * GLINT_BVH_WIDTH;
    *near = load_boxes(f->sign > 0 ? low_w : high_w) * f->sign;
    boxes far = load_boxes(f->sign > 0 ? high_w : low_w) * f->sign;
    boxes_mask met = (far >= f->begin) & (*near <= farthest);
#pragma unroll
    for (int i = 0; i < 2; i++) {
        const int k = across_axis(f->along, i) * GLINT_BVH_WIDTH;
        const scalar *slope = f->slope[i], *offset = f->offset[i];
        boxes at_low = load_boxes(slope[0] > 0 ? low_w : high_w);
        boxes at_high = load_boxes(slope[1] > 0 ? high_w : low_w);
        met &= load_boxes(high + k) >= fused((boxes)slope[0], at_low, (boxes)offset[0]);
        met &= load_boxes(low + k) <= fused((boxes)slope[1], at_high, (boxes)offset[1]);
    }
    return box_bits(met);
}

// frustum_meets_boxes for the triangles of a cluster, lane by lane.
static inline uint frustum_meets_triangles(const frustum *f, global const float *cluster, int count,
                                           scalar farthest)
{
    global const uchar *corners = (global const uchar *)(cluster + GLINT_CLUSTER_CORNERS);
    const uchar16 a = vload16(0, corners), b = vload16(1, corners), c = vload16(2, corners);
    block along =
        FROM_SCENE(cluster, f->along, load_block(cluster + f->along * GLINT_CLUSTER_LANES));
    block distance = along * f->sign;
    block outside[4];
#pragma unroll
    for (int i = 0; i < 2; i++) {
        const int k = across_axis(f->along, i);
        block across = FROM_SCENE(cluster, k, load_block(cluster + k * GLINT_CLUSTER_LANES));
        outside[2 * i] = fused(block_of(f->slope[i][0]), along, block_of(f->offset[i][0])) - across;
        outside[2 * i + 1] =
            across - fused(block_of(f->slope[i][1]), along, block_of(f->offset[i][1]));
    }
    block_mask met = BLOCK_LANES < (scalar)count;
    block near_a = permute_block(distance, a), near_b = permute_block(distance, b);
    block near_c = permute_block(distance, c);
    met &= (near_a <= farthest) | (near_b <= farthest) | (near_c <= farthest);
#pragma unroll
    for (int i = 0; i < 4; i++) {
        block at_a = permute_block(outside[i], a), at_b = permute_block(outside[i], b);
        block at_c = permute_block(outside[i], c);
        met &= (at_a <= R(0.0)) | (at_b <= R(0.0)) | (at_c <= R(0.0));
    }
    return block_bits(met);
}
