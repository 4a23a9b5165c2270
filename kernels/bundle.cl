// Tests a bundle of rays with similar directions against a leaf. The bundle's frustum selects
// triangles. Then the loop runs either over these triangles, each against all rays, or over the
// rays, each against all triangles; it takes the cheaper order. Both orders use the same
// operations, so the hits are the same, bit for bit.

// Rays of a packet that run along one axis, and their frustum.
typedef struct bundle {
    const packet *rays;
    frustum bounds;
    mask active;
    int axes;        // bit k: some ray's largest component is k
    scalar farthest; // along the frustum's axis; no closest hit lies beyond
} bundle;

static inline void update_farthest(bundle *b, const closest *hit)
{
    real end = fused(hit->t, b->bounds.speed, b->bounds.w);
    scalar farthest = largest_lane(SELECT(b->active, end, real_of(-SCENE_END))) + FRUSTUM_SLACK;
    b->farthest = SMALLER(farthest, SCENE_END);
}

static inline bundle make_bundle(const packet *p, int along, scalar sign, mask active)
{
    bundle b;
    b.rays = p;
    b.bounds = make_frustum(p->origin, p->direction, along, sign, active);
    b.active = active;
    b.axes = 0;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        b.axes |= any_lane(active & (p->axis == (lane_int)k)) ? 1 << k : 0;
    }
    b.farthest = SCENE_END;
    return b;
}

// The rays that may meet a box. `box` counts the children of all nodes.
static inline uint rays_at_box(const bundle *b, const scene_buffers *scene, int box,
                               const closest *hit)
{
    node_pointer node = node_at(scene, box / GLINT_BVH_WIDTH);
    return mask_bits(b->active & rays_meet_box(b->rays, node, box % GLINT_BVH_WIDTH, hit->t));
}

// Tests some rays against all triangles of a cluster. True if a ray has hit a triangle.
static inline bool intersect_by_rays(const packet *p, uint rays, lanes_int from, const leaf *leaf,
                                     closest *hit)
{
    lone_ray alone[GLINT_WIDTH];
    cluster_test tests[GLINT_WIDTH];
    int count = 0;
    for (uint left = rays; left != 0; left &= left - 1) {
        alone[count] = take_ray(p, lowest_bit(left), from);
        test_cluster(&alone[count], leaf, &tests[count]);
        count++;
    }
    bool found = false;
    for (int i = 0; i < count; i++, rays &= rays - 1) {
        found |= take_nearest(&alone[i], leaf, &tests[i], hit, lowest_bit(rays));
    }
    return found;
}

// With more triangles than this, it pays off to find the rays that meet the cluster at all.
#define SPARSE_TRIANGLES 4

// Tests the bundle against a cluster. `from` is the place of the triangle that each ray starts on
// and cannot hit; −1: none. True if a ray has hit a triangle.
static inline bool intersect_cluster(const bundle *b, const scene_buffers *scene, int index,
                                     int box, lanes_int from, closest *hit)
{
    global const float *cluster = scene->clusters + (size_t)index * GLINT_CLUSTER_VALUES;
    const int count = count_of_cluster(cluster);
    uint met = frustum_meets_triangles(&b->bounds, cluster, count, b->farthest);
    const leaf leaf = leaf_at(scene, index);
    bool found = false;
    if (GLINT_WIDTH > 1 && popcount(met) > SPARSE_TRIANGLES) {
        uint rays = rays_at_box(b, scene, box, hit);
        if (popcount(rays) < popcount(met)) {
            return intersect_by_rays(b->rays, rays, from, &leaf, hit);
        }
    }
    real room[3];
    const real *origin = origins_at_leaf(b->rays, &leaf, room);
    for (; met != 0; met &= met - 1) {
        found |= intersect_triangle(b->rays, origin, b->axes, &leaf, leaf.first + lowest_bit(met),
                                    from, b->active, hit);
    }
    return found;
}
