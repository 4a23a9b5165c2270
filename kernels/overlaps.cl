// Rule 5 where solids touch or overlap: the media on both sides of what a ray meets. All surfaces of
// solids in one place are crossed at once, whatever their order. The solid with the highest medium
// is there, and of those surfaces its own is the one that light meets. Where the same is there on
// both sides there is no surface at all. A surface that bounds no solid is met before those that do;
// what passes it has crossed them all.
// What rounding may move a hit along the normal, of the distance and the scene's size: the sheared
// corners and the products of them take some eight roundings.
#define CROSSING_SLACK (R(16.0) * EPSILON)

// How far from the surface, along its normal, others are in one place with it.
static inline real reach_of_place(const surface *s, real t)
{
    const scalar of_offset = (scalar)GLINT_TOUCHING / START_OFFSET;
#if GLINT_LOCAL_ORIGINS
    const real size = s->size;
#else
    const real size = real_of(1);
#endif
    return fused(t + size, real_of(CROSSING_SLACK), s->offset * of_offset);
}

#if GLINT_OVERLAPS

// Solids that a ray enters or leaves in one place; more are not looked at.
#define CROSSED_MAX 16
// The cosine between planes that may be in one place.
#define NEARLY_PARALLEL R(0.99)
// A solid that a ray enters or leaves, and the lowest triangle by which it does. Of one that it
// enters and leaves at once nothing is crossed.
typedef struct crossed_solid {
    int component, place, number;
    lane_int medium;
    bool enters, stays;
    scalar b1, b2;
} crossed_solid;

typedef struct crossed_solids {
    int count;
    crossed_solid solids[CROSSED_MAX];
    crossed_solid other; // what bounds no solid there; its place is −1 where there is nothing
} crossed_solids;

// One ray where it meets a triangle, whose winding makes `normal`.
typedef struct crossing_ray {
    stream_ray ray;
    scalar normal[3], begin; // from that distance on, to ray.farthest
    bool enters;
    int place;
} crossing_ray;

static inline void cross_also(crossed_solids *all, const crossed_solid *solid)
{
    if (solid->medium == 0) {
        if (all->other.place < 0 || solid->number < all->other.number) {
            all->other = *solid;
        }
        return;
    }
    for (int i = 0; i < all->count; i++) {
        crossed_solid *other = &all->solids[i];
        if (other->component == solid->component && other->enters == solid->enters) {
            if (solid->number < other->number) {
                *other = *solid;
            }
            return;
        }
    }
    if (all->count < CROSSED_MAX) {
        all->solids[all->count++] = *solid;
    }
}

// The cosine between two planes, times a positive number.
static inline scalar turn_of_planes(const scalar n[3], const float at[9], scalar *squared)
{
    scalar turn = R(0.0);
    *squared = R(0.0);
    scalar a[3], b[3];
#pragma unroll
    for (int k = 0; k < 3; k++) {
        a[k] = (scalar)at[3 + k] - (scalar)at[k];
        b[k] = (scalar)at[6 + k] - (scalar)at[k];
    }
#pragma unroll
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const scalar own = a[i] * b[j] - a[j] * b[i];
        turn = fused(own, n[k], turn);
        *squared = fused(own, own, *squared);
    }
    return turn;
}

// Triangle i of a leaf, if it is in the place that the ray crosses.
static inline void cross_triangle(const crossing_ray *c, const scene_buffers *scene,
                                  const leaf *leaf, const cluster_test *test, int i,
                                  crossed_solids *all)
{
    const int place = leaf->first + i, lane = c->ray.lane;
    const int number = leaf->numbers[place];
    const glint_solid_record solid = scene->solids[number];
    if (place == c->place || (solid.medium & GLINT_SOLID_TOUCHES) == 0) {
        return;
    }
    closest trial = no_hit();
    trial.t = real_of(c->ray.farthest);
    if (!take_if_nearer(&c->ray.ray, leaf, test, i, &trial, lane) ||
        LANE(trial.t, lane) < c->begin) {
        return;
    }
    float at[9];
    scalar squared;
    load_triangle(leaf->cluster, i, at);
    const scalar turn = turn_of_planes(c->normal, at, &squared);
    if (!(turn * turn >= NEARLY_PARALLEL * NEARLY_PARALLEL * squared)) {
        return;
    }
    crossed_solid crossed;
    crossed.component = solid.component;
    crossed.place = place;
    crossed.number = number;
    crossed.medium = (lane_int)(solid.medium & ~GLINT_SOLID_TOUCHES);
    crossed.enters = (turn > R(0.0)) == c->enters;
    crossed.stays = false;
    crossed.b1 = LANE(trial.b1, lane);
    crossed.b2 = LANE(trial.b2, lane);
    cross_also(all, &crossed);
}

// What else is in the place that a ray crosses.
static inline void find_crossed(const crossing_ray *c, const scene_buffers *scene,
                                crossed_solids *all)
{
    int stack[GLINT_TRAVERSAL_STACK];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const int child = stack[--size];
        if (child >= 0) {
            node_pointer node = node_at(scene, child);
            for (uint met = boxes_between(&c->ray, node, c->begin); met != 0; met &= met - 1) {
                stack[size++] = child_of(node, lowest_bit(met));
            }
            continue;
        }
        const leaf leaf = leaf_at(scene, ~child);
        cluster_test test;
        test_cluster(&c->ray.ray, &leaf, &test);
        for (uint left = test.inside; left != 0; left &= left - 1) {
            cross_triangle(c, scene, &leaf, &test, lowest_bit(left), all);
        }
    }
}

// A path's media on both sides of a place.
typedef struct media_sides {
    lane_int before, beyond;
    bool lost;
} media_sides;

static inline void mark_staying(crossed_solids *all)
{
    for (int i = 0; i < all->count; i++) {
        for (int j = 0; j < all->count; j++) {
            all->solids[i].stays |= i != j && all->solids[i].component == all->solids[j].component;
        }
    }
}

// A solid that is left and that the path is not inside is one that it began in.
static inline media_sides cross_all(lane_int media, const crossed_solids *all)
{
    media_sides sides = {media, media, false};
    for (int i = 0; i < all->count; i++) {
        const crossed_solid *solid = &all->solids[i];
        if (!solid->stays && !solid->enters && !remove_medium(&sides.beyond, solid->medium)) {
            sides.lost |= insert_medium(&sides.before, solid->medium);
        }
    }
    for (int i = 0; i < all->count; i++) {
        const crossed_solid *solid = &all->solids[i];
        if (!solid->stays && solid->enters) {
            sides.lost |= insert_medium(&sides.beyond, solid->medium);
        }
    }
    return sides;
}

// Of the surfaces in one place the one that light meets: of solids that which is there on one side,
// and not on the other.
static inline const crossed_solid *shown_of(const crossed_solids *all, const media_sides *sides)
{
    const lane_int wanted = max(top_medium(sides->before), top_medium(sides->beyond));
    const crossed_solid *shown = all->other.place >= 0 ? &all->other : 0;
    for (int i = 0; i < all->count; i++) {
        const crossed_solid *solid = &all->solids[i];
        if (all->other.place < 0 && !solid->stays && solid->medium == wanted &&
            (shown == 0 || solid->number < shown->number)) {
            shown = solid;
        }
    }
    return shown;
}

// What rays come to in the places where they meet something.
typedef struct crossing {
    lanes_int before, beyond; // stacks of media
    lanes_int lost;           // 1: of one of these
    lanes_int medium;         // of the surface that is met; 0: it bounds no solid
    lanes_int gone;           // 1: there is none, as the same solid is on both sides
    lanes_int several;        // 1: others are in one place with it
    bool changed;             // some ray meets another surface than it hit first
} crossing;

// What one ray hit.
static inline crossed_solid first_crossed(const scene_buffers *scene, const closest *hit,
                                          lanes_int outside, int lane, bool *touches)
{
    crossed_solid own;
    own.place = (int)LANE_INT(hit->place, lane);
    own.number = scene->numbers[own.place];
    const glint_solid_record solid = scene->solids[own.number];
    *touches = (solid.medium & GLINT_SOLID_TOUCHES) != 0;
    own.component = solid.component;
    own.medium = (lane_int)(solid.medium & ~GLINT_SOLID_TOUCHES);
    own.enters = LANE_INT(outside, lane) != 0;
    own.stays = false;
    own.b1 = LANE(hit->b1, lane);
    own.b2 = LANE(hit->b2, lane);
    return own;
}

// Adds what else is in the place that one ray crosses; `depth` is how far before and behind it
// along the ray that place reaches.
static inline void cross_others(const scene_buffers *scene, const packet *p, const path *ray,
                                const surface *s, const closest *hit, scalar depth, int lane,
                                bool enters, crossed_solids *all)
{
    crossing_ray c;
    const scalar sign = enters ? R(1.0) : R(-1.0);
    c.normal[0] = sign * LANE(s->geometric_normal.x, lane);
    c.normal[1] = sign * LANE(s->geometric_normal.y, lane);
    c.normal[2] = sign * LANE(s->geometric_normal.z, lane);
    c.enters = enters;
    c.place = (int)LANE_INT(hit->place, lane);
    take_stream_ray(p, 0, lane, ray->from, &c.ray);
    c.begin = LANE(hit->t, lane) - depth;
    c.ray.farthest = LANE(hit->t, lane) + depth;
    find_crossed(&c, scene, all);
    mark_staying(all);
}

// Notes what one ray comes to, and makes the surface that it meets its hit.
static inline void note_crossing(const scene_buffers *scene, const crossed_solids *all,
                                 lane_int media, int lane, closest *hit, crossing *c)
{
    const media_sides sides = cross_all(media, all);
    const bool by_other = all->other.place >= 0;
    LANE_INT(c->before, lane) = sides.before;
    LANE_INT(c->beyond, lane) = sides.beyond;
    LANE_INT(c->lost, lane) = sides.lost;
    LANE_INT(c->gone, lane) = !by_other && scene->media[top_medium(sides.before)].material ==
                                               scene->media[top_medium(sides.beyond)].material;
    LANE_INT(c->several, lane) = all->count > (by_other ? 0 : 1);
    const crossed_solid *met = shown_of(all, &sides);
    if (met == 0) {
        LANE_INT(c->medium, lane) = all->solids[0].medium;
        return;
    }
    LANE_INT(c->medium, lane) = met->medium;
    if (met->place != (int)LANE_INT(hit->place, lane)) {
        LANE_INT(hit->place, lane) = met->place;
        LANE(hit->b1, lane) = met->b1;
        LANE(hit->b2, lane) = met->b2;
        c->changed = true;
    }
}

// Finds the media on both sides of what the rays in `met` meet, and the surface that is there: *hit
// and *t are then its.
static inline surface find_surface_in_place(const scene_buffers *scene, const path *ray, mask met,
                                            closest *hit, triangle *t)
{
    surface s = find_surface(scene, ray, hit, t);
    const packet p = packet_of_paths(ray);
    const real reach = reach_of_place(&s, hit->t);
    const real cosine = fabs(dot3(s.geometric_normal, ray->direction));
    const real depth = reach / LARGER(cosine, real_of(CROSSING_SLACK));
    const lanes_int outside = SELECT(s.outside, int_of(1), int_of(0));
    crossing c = {ray->media, ray->media, int_of(0), int_of(0), int_of(0), int_of(0), false};
    for (uint left = mask_bits(met); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        crossed_solids all;
        bool touches;
        const crossed_solid own = first_crossed(scene, hit, outside, lane, &touches);
        all.count = 0;
        all.other.place = -1;
        cross_also(&all, &own);
        if (touches) {
            cross_others(scene, &p, ray, &s, hit, LANE(depth, lane), lane, own.enters, &all);
        }
        note_crossing(scene, &all, LANE_INT(ray->media, lane), lane, hit, &c);
    }
    if (c.changed) {
        *t = load_triangles(scene, SELECT(met, hit->place, int_of(0)), met);
        s = find_surface(scene, ray, hit, t);
    }
    s.medium = c.medium;
    s.media_before = c.before;
    s.media_beyond = c.beyond;
    s.media_lost = c.lost != (lane_int)0;
    s.offset = SELECT(c.several != (lane_int)0, s.offset + R(2.0) * reach, s.offset);
    s.coverage = SELECT(c.gone != (lane_int)0, real_of(0), s.coverage);
    return s;
}

#else

static inline surface find_surface_in_place(const scene_buffers *scene, const path *ray, mask met,
                                            closest *hit, triangle *t)
{
    return find_surface(scene, ray, hit, t);
}

#endif
