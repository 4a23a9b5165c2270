// Closest hits of a packet of rays in the wide tree: one stack for all rays of the packet. A node's
// boxes are tested all at once against the ranges of the packet's rays; a box that passes is then
// tested against each ray, so that rays that have spread apart do not visit all that lies between.
// At a leaf the loop runs over its triangles, each tested against all rays, or over the rays that meet
// its box, each tested against all triangles, whichever is less work. The same operations in either
// order: the same hits, bit for bit.

// Puts the children that some ray meets on the stack, the nearest on top.
static inline int push_children(const packet *p, global const float *node, mask active,
                                const closest *hit, waiting *stack, int size)
{
    boxes entries;
    scalar farthest = largest_lane(SELECT(active, hit->t, real_of(-HUGE)));
    uint met = packet_meets_boxes(p, node, farthest, &entries);
    int base = size;
    while (met != 0) {
        int child = lowest_bit(met);
        met &= met - 1;
        uint rays = 1;
#if GLINT_WIDTH > 1
        rays = mask_bits(active & rays_meet_box(p, node, child, hit->t));
        if (rays == 0) {
            continue;
        }
#endif
        size = push_waiting(stack, base, size, node, child, ((scalar *)&entries)[child], rays);
    }
    return size;
}

static inline void intersect_by_triangle(const packet *p, global const float *cluster,
                                         global const int *numbers, int first, int count,
                                         lanes_int from, mask active, closest *hit)
{
    for (int lane = 0; lane < count; lane++) {
        int place = first + lane;
        float vertices[9];
        load_triangle(cluster, lane, vertices);
        intersect_triangle(p, vertices, place, numbers[place], active & (from != (lane_int)place),
                           hit);
    }
}

// A loop over rays pays from this many triangles for each ray.
#define TRIANGLES_PER_RAY 2

static inline void intersect_cluster(const packet *p, global const float *clusters,
                                     global const int *numbers, int index, uint rays,
                                     lanes_int from, mask active, closest *hit)
{
    global const float *cluster = clusters + (size_t)index * GLINT_CLUSTER_VALUES;
    const int count = ((global const int *)cluster)[GLINT_CLUSTER_COUNT];
    const int first = index * GLINT_CLUSTER_LANES;
    if (GLINT_WIDTH > 1 && (int)popcount(rays) * TRIANGLES_PER_RAY > count) {
        intersect_by_triangle(p, cluster, numbers, first, count, from, active, hit);
        return;
    }
    while (rays != 0) {
        int ray = lowest_bit(rays);
        rays &= rays - 1;
        intersect_by_ray(p, ray, cluster, numbers, first, count, (int)LANE_INT(from, ray), hit);
    }
}

// `from` is the place of the triangle that each ray starts on, which it cannot hit: −1 for none.
static inline closest trace_packet(global const float *nodes, global const float *clusters,
                                   global const int *numbers, real3 origin, real3 direction,
                                   lanes_int from, mask active)
{
    closest hit;
    hit.t = real_of(HUGE);
    hit.b1 = real_of(0);
    hit.b2 = real_of(0);
    hit.place = int_of(-1);
    hit.triangle = int_of(0x7fffffff);
    if (!any_lane(active)) {
        return hit;
    }
    packet p = make_packet(origin, direction, active);
    waiting stack[GLINT_TRAVERSAL_STACK];
    stack[0].child = 0;
    stack[0].entry = 0;
    stack[0].rays = mask_bits(active);
    int size = 1;
    while (size > 0) {
        waiting next = stack[--size];
        if (next.entry > largest_lane(SELECT(active, hit.t, real_of(-HUGE)))) {
            continue;
        }
        if (next.child >= 0) {
            global const float *node =
                nodes + (size_t)next.child * (GLINT_NODE_VALUES * GLINT_BVH_WIDTH);
            size = push_children(&p, node, active, &hit, stack, size);
            continue;
        }
        intersect_cluster(&p, clusters, numbers, ~next.child, next.rays, from, active, &hit);
    }
    return hit;
}
