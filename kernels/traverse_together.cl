// Finds the closest hits of a tile's rays, group by group, in the wide tree. Coherent groups, whose
// rays stay close to each other, go through the tree together: as one frustum around their frusta,
// with one stack. Other groups go alone. A node's boxes are all tested at once against the frustum.
// At a leaf each group is tested in turn (bundle.cl). If the rays of a group spread apart, they
// join a stream instead (stream.cl). The hits are the same in all cases, bit for bit.

// The number of groups of rays that are followed at the same time.
#define PATH_GROUPS (GLINT_INTERREFLECTION || GLINT_SPLIT ? TILE_GROUPS : 1)
// The index of group i. With a single group it is a constant, so that compilers can use it.
#define SLOT(i) (PATH_GROUPS == 1 ? 0 : (i))

// The frusta of a tile's groups. Each block has one lane per group. Groups that do not take part
// have an empty frustum.
typedef struct group_frusta {
    block slope[2][2], offset[2][2]; // see frustum
    block begin, farthest;
} group_frusta;

// Rays with a valid direction, and an origin in the scene. NaN, which optics may produce, gives
// false.
static inline mask is_sound(real3 origin, real3 direction)
{
    real place = fabs(origin.x) + fabs(origin.y) + fabs(origin.z);
    real length = fabs(direction.x) + fabs(direction.y) + fabs(direction.z);
    return (place < SCENE_END) & (length < R(2.0)) & (length > R(0.5));
}

static inline closest no_hit(void)
{
    closest hit;
    hit.t = real_of(HUGE);
    hit.b1 = real_of(0);
    hit.b2 = real_of(0);
    hit.place = int_of(-1);
    return hit;
}

static inline bool any_active(const mask *active)
{
    mask some = active[0];
    for (int g = 1; g < PATH_GROUPS; g++) {
        some = some | active[g];
    }
    return any_lane(some);
}

static inline group_frusta empty_frusta(void)
{
    group_frusta f;
    f.begin = block_of(HUGE);
    f.farthest = block_of(-HUGE);
#pragma unroll
    for (int i = 0; i < 2; i++) {
        f.slope[i][0] = f.slope[i][1] = block_of(0);
        f.offset[i][0] = block_of(HUGE);
        f.offset[i][1] = block_of(-HUGE);
    }
    return f;
}

static inline void set_frustum(group_frusta *f, int group, const frustum *one)
{
    ((scalar *)&f->begin)[group] = one->begin;
    ((scalar *)&f->farthest)[group] = SCENE_END;
#pragma unroll
    for (int i = 0; i < 2; i++) {
#pragma unroll
        for (int side = 0; side < 2; side++) {
            ((scalar *)&f->slope[i][side])[group] = one->slope[i][side];
            ((scalar *)&f->offset[i][side])[group] = one->offset[i][side];
        }
    }
}

// Sets *all to the frustum around the frusta of all groups. Compares its cross-section with the sum
// of the groups' cross-sections, halfway between the start and the scene's end. True if it is not
// much larger: then the groups are coherent.
static inline bool enclose_frusta(const group_frusta *f, int along, scalar sign, frustum *all)
{
    all->along = along;
    all->sign = sign;
    all->begin = smallest_of_16(f->begin);
    all->wide = false;
    // Enclose the planes of all groups, for both axes across.
    const scalar distance = LARGER(SCENE_REACH - all->begin, R(0.0625));
    block taking_part = SELECT(f->farthest > R(0.0), block_of(1), block_of(0));
    block areas = taking_part;
    scalar area = R(1.0);
#pragma unroll
    for (int i = 0; i < 2; i++) {
        scalar ends[2][2]; // [side][begin, end]
        block half_way[2];
#pragma unroll
        for (int side = 0; side < 2; side++) {
            const scalar turn = side == 0 ? R(1.0) : R(-1.0);
            block at_begin =
                fused(f->slope[i][side], block_of(sign * all->begin), f->offset[i][side]);
            block at_end = fused(f->slope[i][side], block_of(sign * (all->begin + distance)),
                                 f->offset[i][side]);
            ends[side][0] = turn * (smallest_of_16(turn * at_begin) - FRUSTUM_SLACK);
            ends[side][1] = turn * (smallest_of_16(turn * at_end) - FRUSTUM_SLACK);
            half_way[side] = at_begin + at_end;
            scalar slope = (ends[side][1] - ends[side][0]) / distance;
            all->slope[i][side] = sign * slope;
            all->offset[i][side] = ends[side][0] - slope * all->begin;
        }
        areas *= half_way[1] - half_way[0];
        area *= ends[1][0] + ends[1][1] - ends[0][0] - ends[0][1];
    }
    return area < COMPACT * sum_of_16(SELECT(taking_part > R(0.0), areas, block_of(0)));
}

// The groups whose frusta reach into a box before their farthest hits. `box` counts the children of
// all nodes.
static inline uint groups_at_box(const group_frusta *f, const frustum *all,
                                 const scene_buffers *scene, int box)
{
    node_pointer low = node_at(scene, box / GLINT_BVH_WIDTH) + box % GLINT_BVH_WIDTH;
    node_pointer high = low + 3 * GLINT_BVH_WIDTH;
    const scalar low_w = low[all->along * GLINT_BVH_WIDTH];
    const scalar high_w = high[all->along * GLINT_BVH_WIDTH];
    const scalar near = all->sign > 0 ? low_w : -high_w, far = all->sign > 0 ? high_w : -low_w;
    block_mask met = (f->farthest >= near) & (f->begin <= far);
#pragma unroll
    for (int i = 0; i < 2; i++) {
        const int k = across_axis(all->along, i) * GLINT_BVH_WIDTH;
        const block *slope = f->slope[i], *offset = f->offset[i];
        block at_low = SELECT(slope[0] > R(0.0), block_of(low_w), block_of(high_w));
        block at_high = SELECT(slope[1] > R(0.0), block_of(high_w), block_of(low_w));
        met &= fused(slope[0], at_low, offset[0]) <= block_of(high[k]);
        met &= fused(slope[1], at_high, offset[1]) >= block_of(low[k]);
    }
    return block_bits(met);
}

// A traversal of some groups together; `groups` are bits.
typedef struct party {
    frustum bounds;
    scalar farthest;
    uint groups;
} party;

// Puts the children that some ray may meet on the stack, the nearest on top.
static inline int push_children(const party *p, const scene_buffers *scene, int node,
                                waiting *stack, int size)
{
    boxes near;
    uint met = frustum_meets_boxes(&p->bounds, node_at(scene, node), p->farthest, &near);
    int base = size;
    for (; met != 0; met &= met - 1) {
        int child = lowest_bit(met);
        size = push_waiting(scene, stack, base, size, node, child, ((scalar *)&near)[child]);
    }
    return size;
}

static inline void meet_leaf(party *p, group_frusta *f, bundle *bundles, const scene_buffers *scene,
                             const waiting *leaf, const path *rays, closest *hits)
{
    const bool several = has_several_bits(p->groups);
    uint groups = p->groups;
    if (several) {
        groups &= groups_at_box(f, &p->bounds, scene, leaf->box);
    }
    bool found = false;
    for (; groups != 0; groups &= groups - 1) {
        int g = SLOT(lowest_bit(groups));
        bundle *b = &bundles[g];
        if (intersect_cluster(b, scene, ~leaf->child, leaf->box, rays[g].from, &hits[g])) {
            update_farthest(b, &hits[g]);
            ((scalar *)&f->farthest)[g] = b->farthest;
            found = true;
        }
    }
    if (found) {
        p->farthest =
            several ? largest_of_16(f->farthest) : bundles[SLOT(lowest_bit(p->groups))].farthest;
    }
}

static inline void trace_party(party *p, group_frusta *f, bundle *bundles,
                               const scene_buffers *scene, const path *rays, closest *hits)
{
    waiting stack[GLINT_TRAVERSAL_STACK];
    stack[0].child = 0;
    stack[0].entry = -SCENE_END;
    stack[0].box = 0;
    int size = 1;
    while (size > 0) {
        waiting next = stack[--size];
        if (next.entry > p->farthest) {
            continue;
        }
        if (next.child < 0) {
            meet_leaf(p, f, bundles, scene, &next, rays, hits);
            continue;
        }
        size = push_children(p, scene, next.child, stack, size);
    }
}

// Finds the direction of the first of the remaining rays: the axis, and its sign along the axis.
static inline void choose_axis(const packet *packets, const mask *left, int *along, scalar *sign)
{
    int group = 0;
    while (!any_lane(left[group])) {
        group++;
    }
    const packet *p = &packets[group];
    const int leader = lowest_bit(mask_bits(left[group]));
    *along = (int)LANE_INT(p->axis, leader);
    *sign = LANE(p->direction[*along], leader) > 0 ? R(1.0) : R(-1.0);
}

#if GLINT_GEOMETRY && GLINT_INTERREFLECTION
// The rays of a tile's groups that are not traced yet.
typedef struct crowd {
    packet packets[PATH_GROUPS];
    bundle bundles[PATH_GROUPS];
    mask left[PATH_GROUPS];
    stream apart; // the rays of wide groups
} crowd;

// Takes the rays that run along the axis, in the direction of `sign`, out of the remaining rays.
// Returns the groups with narrow frusta, as bits, and sets their frusta. The rays of the other
// groups join the stream.
static inline uint divide_crowd(crowd *c, const path *rays, int along, scalar sign,
                                group_frusta *frusta)
{
    uint narrow = 0;
    *frusta = empty_frusta();
    c->apart.count = 0;
    for (int g = 0; g < PATH_GROUPS; g++) {
        if (!any_lane(c->left[g])) {
            continue;
        }
        mask together = rays_along(&rays[g].direction, along, sign, c->left[g]);
        if (!any_lane(together)) {
            continue;
        }
        c->left[g] = c->left[g] & !together;
        c->bundles[g] = make_bundle(&c->packets[g], along, sign, together);
        if (c->bundles[g].bounds.wide) {
            join_stream(&c->apart, &c->packets[g], g, together, rays[g].from);
        } else {
            narrow |= 1u << g;
            set_frustum(frusta, g, &c->bundles[g].bounds);
        }
    }
    return narrow;
}
#endif

// Finds the closest hits of the active rays that are not looked up.
static inline void trace_groups(const scene_buffers *scene, const path *rays, const mask *active,
                                closest *hits)
{
    for (int g = 0; g < PATH_GROUPS; g++) {
        hits[SLOT(g)] = no_hit();
    }
#if GLINT_GEOMETRY && GLINT_INTERREFLECTION
    // Gather the rays to trace.
    crowd c;
    for (int g = 0; g < PATH_GROUPS; g++) {
        const path *ray = &rays[g];
        c.left[g] =
            active[g] & (ray->looked_up == (lane_int)0) & is_sound(ray->origin, ray->direction);
        if (any_lane(c.left[g])) {
            c.packets[g] = packet_of_paths(ray);
        }
    }
    // Trace the rays of one axis and direction at a time: first the stream, then the narrow groups.
    while (any_active(c.left)) {
        int along;
        scalar sign;
        choose_axis(c.packets, c.left, &along, &sign);
        group_frusta frusta;
        uint groups = divide_crowd(&c, rays, along, sign, &frusta);
        trace_stream(&c.apart, scene, along, sign, hits);
        frustum around;
        const bool together =
            has_several_bits(groups) && enclose_frusta(&frusta, along, sign, &around);
        while (groups != 0) {
            party p;
            p.groups = together ? groups : groups & -groups;
            p.bounds = together ? around : c.bundles[SLOT(lowest_bit(groups))].bounds;
            p.farthest = SCENE_END;
            trace_party(&p, &frusta, c.bundles, scene, rays, hits);
            groups &= ~p.groups;
        }
    }
#endif
}
