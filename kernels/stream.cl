// Finds the closest hits of a tile's rays that are too incoherent for a frustum. A stream of these
// rays goes through the tree together, node by node. Each child has a list of the rays that meet
// its box. One step tests a ray against all boxes of a node, or all triangles of a leaf. So the
// tests of one ray do not wait for another's, and a node or leaf is fetched once for all rays.

#define STREAM_RAYS (TILE_GROUPS * GLINT_WIDTH)
// The lists end with up to a block's lanes of unused entries.
#define STREAM_PADDING 16
// The number of rays that are tested against a leaf before the first of them takes its hit.
#define STREAM_TESTS 8
// Up to this number of rays visit a node's children without sorting them by distance.
#define FEW_RAYS 4

typedef struct stream_ray {
    lone_ray ray;
    scalar inverse[3], widening[3]; // see boxes_at_ray
    int near[3];                    // offsets of a node's near sides
    scalar farthest;
    int group, lane; // of the packets
} stream_ray;

// The rays that may meet a node or leaf, as numbers in stream.list.
typedef struct stream_child {
    int child, first, count;
} stream_child;

typedef struct stream {
    int count;
    stream_ray rays[STREAM_RAYS];
    int list[STREAM_RAYS * GLINT_TRAVERSAL_STACK + STREAM_PADDING]; // lists of all waiting nodes
    // Of the current node: its rays, and the children that each of them may meet, as bits.
    int here[STREAM_RAYS + STREAM_PADDING], met[STREAM_RAYS + STREAM_PADDING];
} stream;

// Takes a ray out of the packet of a group.
static inline void take_stream_ray(const packet *p, int group, int lane, lanes_int from,
                                   stream_ray *r)
{
    r->ray = take_ray(p, lane, from);
#pragma unroll
    for (int k = 0; k < 3; k++) {
        r->inverse[k] = LANE(p->inverse[k], lane);
        r->widening[k] = FRUSTUM_SLACK * fabs(r->inverse[k]);
        r->near[k] = (r->inverse[k] > R(0.0) ? k : 3 + k) * GLINT_BVH_WIDTH;
    }
    r->farthest = SCENE_END;
    r->group = group;
    r->lane = lane;
}

static inline void join_stream(stream *s, const packet *p, int group, mask these, lanes_int from)
{
    for (uint left = mask_bits(these); left != 0; left &= left - 1) {
        take_stream_ray(p, group, lowest_bit(left), from, &s->rays[s->count++]);
    }
}

// The boxes of a node that a ray may meet between `begin` and its farthest hit, as bits. The test
// is rays_meet_box.
static inline uint boxes_between(const stream_ray *r, node_pointer node, scalar begin)
{
    boxes near = (boxes)begin, far = (boxes)r->farthest;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        node_pointer near_side = node + r->near[k];
        node_pointer far_side = node + (2 * k + 3) * GLINT_BVH_WIDTH - r->near[k];
        const boxes inverse = (boxes)r->inverse[k], widening = (boxes)r->widening[k];
        boxes enter = fused(load_boxes(near_side) - r->ray.origin[k], inverse, -widening);
        boxes leave = fused(load_boxes(far_side) - r->ray.origin[k], inverse, widening);
        near = LARGER(enter, near);
        far = SMALLER(leave, far);
    }
    return box_bits(near <= far * FAR_SLACK);
}

static inline uint boxes_at_ray(const stream_ray *r, node_pointer node)
{
    return boxes_between(r, node, R(0.0));
}

// Writes the numbers of the current node's rays that may meet a child into `list`; returns their
// count.
static inline int list_rays(const stream *s, int count, int child, int *list)
{
    int listed = 0;
    for (int i = 0; i < count; i += 16) {
        int16 met = vload16(0, s->met + i) & (int16)(1 << child);
        uint bits = bits_of_int16(met != 0);
        bits &= i + 16 > count ? (1u << (count - i)) - 1 : 0xffff;
        store_chosen(vload16(0, s->here + i), bits, list + listed);
        listed += (int)popcount(bits);
    }
    return listed;
}

// Lists the children to visit; the last is visited first. The order is falling distance along the
// axis. For few rays sorting does not pay off, so the children keep their order.
static inline int order_children(node_pointer node, uint met, int rays, int along, scalar sign,
                                 int children[GLINT_BVH_WIDTH])
{
    const bool in_order = rays > FEW_RAYS;
    boxes near = load_boxes(node + (sign > 0 ? along : 3 + along) * GLINT_BVH_WIDTH) * sign;
    scalar distances[GLINT_BVH_WIDTH];
    int count = 0;
    for (; met != 0; met &= met - 1) {
        const int child = lowest_bit(met);
        const scalar distance = ((scalar *)&near)[child];
        int i = count++;
        for (; in_order && i > 0 && distances[i - 1] <= distance; i--) {
            distances[i] = distances[i - 1];
            children[i] = children[i - 1];
        }
        distances[i] = distance;
        children[i] = child;
    }
    return count;
}

static inline void stream_meets_leaf(stream *s, const stream_child *child,
                                     const scene_buffers *scene, closest *hits)
{
    const int *list = s->list + child->first;
    const leaf leaf = leaf_at(scene, ~child->child);
    cluster_test tests[STREAM_TESTS];
    for (int begin = 0; begin < child->count; begin += STREAM_TESTS) {
        const int count = min(child->count - begin, STREAM_TESTS);
        for (int i = 0; i < count; i++) {
            test_cluster(&s->rays[list[begin + i]].ray, &leaf, &tests[i]);
        }
        for (int i = 0; i < count; i++) {
            stream_ray *r = &s->rays[list[begin + i]];
            closest *hit = &hits[r->group];
            if (take_nearest(&r->ray, &leaf, &tests[i], hit, r->lane)) {
                r->farthest = LANE(hit->t, r->lane);
            }
        }
    }
}

// Replaces the node on the stack by the children that some ray may meet, the nearest on top.
static inline int push_children_of_stream(stream *s, const stream_child *parent,
                                          const scene_buffers *scene, int along, scalar sign,
                                          stream_child *stack, int size)
{
    node_pointer node = node_at(scene, parent->child);
    uint met = 0;
    for (int i = 0; i < parent->count; i++) {
        s->here[i] = s->list[parent->first + i];
        s->met[i] = (int)boxes_at_ray(&s->rays[s->here[i]], node);
        met |= (uint)s->met[i];
    }
    int children[GLINT_BVH_WIDTH];
    const int count = order_children(node, met, parent->count, along, sign, children);
    int end = parent->first;
    for (int i = 0; i < count; i++) {
        stream_child *next = &stack[size++];
        next->child = child_of(node, children[i]);
        next->first = end;
        next->count = list_rays(s, parent->count, children[i], s->list + end);
        end += next->count;
        prefetch_child(scene, next->child);
    }
    return size;
}

// Finds the closest hits of the stream's rays, which run along one axis in the direction of `sign`.
static inline void trace_stream(stream *s, const scene_buffers *scene, int along, scalar sign,
                                closest *hits)
{
    stream_child stack[GLINT_TRAVERSAL_STACK];
    for (int i = 0; i < s->count; i++) {
        s->list[i] = i;
    }
    stack[0].child = 0;
    stack[0].first = 0;
    stack[0].count = s->count;
    int size = s->count > 0 ? 1 : 0;
    while (size > 0) {
        const stream_child next = stack[--size];
        if (next.child < 0) {
            stream_meets_leaf(s, &next, scene, hits);
        } else {
            size = push_children_of_stream(s, &next, scene, along, sign, stack, size);
        }
    }
}
