// Applies rule 5 where solids touch or overlap: finds the media on both sides of the surfaces in
// one place. A ray crosses all surfaces of solids in one place at once, in any order. The highest
// medium there wins, and light meets the surface of its solid. If the same solid is on both sides,
// there is no surface. A surface that bounds no solid is met before surfaces of solids; light that
// passes it has crossed them all.
//
// CROSSING_SLACK bounds how far rounding moves a hit along the normal, relative to the distance and
// the scene's size. The sheared corners and their products take about eight roundings.
#define CROSSING_SLACK (R(16.0) * EPSILON)

// The distance from the surface, along its normal, within which other surfaces are in one place
// with it.
static inline real reach_of_place(const scene_buffers *scene, const surface *s, real t)
{
    const scalar of_offset = (scalar)GLINT_TOUCHING / START_OFFSET(scene);
    real size = real_of(1);
#if LOCAL_RAYS
    size = HAS(LOCAL_ORIGINS) ? s->size : size;
#endif
    const real reach = fused(t + size, real_of(CROSSING_SLACK), s->offset * of_offset);
#if LOCAL_RAYS
    // place_nearby bounds the rays' rounding by the offset. The corners are rounded, too.
    if (HAS(LOCAL_ORIGINS)) {
        const real nearby =
            LARGER(s->offset * of_offset, s->along_normal * (scalar)GLINT_TOUCHING);
        return SELECT(LARGE_TRIANGLE * t < size, nearby, reach);
    }
#endif
    return reach;
}

#if GLINT_OVERLAPS

// The largest number of solids that a ray enters or leaves in one place. Further solids are
// ignored.
#define CROSSED_MAX 16
// Planes in one place have at least this cosine between them.
#define NEARLY_PARALLEL R(0.99)
// A solid that a ray enters or leaves, and the lowest triangle by which it does. A solid that the
// ray enters and leaves at once is not crossed (`stays`).
typedef struct crossed_solid {
    int component, place, number;
    lane_int medium;
    bool enters, stays;
    scalar b1, b2;
} crossed_solid;

typedef struct crossed_solids {
    int count;
    crossed_solid solids[CROSSED_MAX];
    crossed_solid other; // a surface there that bounds no solid; its place is −1: none
} crossed_solids;

// One ray at a triangle that it meets; `normal` follows the triangle's winding.
typedef struct crossing_ray {
    stream_ray ray;
    scalar normal[3], begin; // the place reaches from `begin` to ray.farthest
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

// Adds triangle i of a leaf, if it is in the place that the ray crosses.
static inline void cross_triangle(const crossing_ray *c, const scene_buffers *scene,
                                  const leaf *leaf, const cluster_test *test, int i,
                                  crossed_solids *all)
{
    const int place = leaf->first + i, lane = c->ray.lane;
    const int number = scene->numbers[place];
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

// Finds the other triangles in the place that a ray crosses.
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

// A path's stacks of media on both sides of a place.
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

// Crosses all solids. If the path leaves a solid that is not in its stack, it began inside this
// solid.
static inline media_sides cross_all(const scene_buffers *scene, lane_int media,
                                    const crossed_solids *all)
{
    media_sides sides = {media, media, false};
    for (int i = 0; i < all->count; i++) {
        const crossed_solid *solid = &all->solids[i];
        if (!solid->stays && !solid->enters &&
            !remove_medium(scene, &sides.beyond, solid->medium)) {
            sides.lost |= insert_medium(scene, &sides.before, solid->medium);
        }
    }
    for (int i = 0; i < all->count; i++) {
        const crossed_solid *solid = &all->solids[i];
        if (!solid->stays && solid->enters) {
            sides.lost |= insert_medium(scene, &sides.beyond, solid->medium);
        }
    }
    return sides;
}

// Returns the surface in one place that light meets. Among solids, it belongs to the medium that is
// on top on one side and not on the other.
static inline const crossed_solid *shown_of(const scene_buffers *scene, const crossed_solids *all,
                                            const media_sides *sides)
{
    const lane_int wanted = max(top_medium(scene, sides->before), top_medium(scene, sides->beyond));
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

// The places where rays meet a surface.
typedef struct crossing {
    lanes_int before, beyond; // stacks of media
    lanes_int lost;           // 1: one of these stacks lost a medium
    lanes_int medium;         // of the surface that light meets; 0: it bounds no solid
    lanes_int gone;           // 1: no surface, because the same solid is on both sides
    lanes_int several;        // 1: other surfaces are in one place with it
    bool changed;             // some ray meets another surface than it hit first
} crossing;

// The hit of one ray as a crossed solid.
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

// Adds the other surfaces in the place that one ray crosses. The place reaches `depth` before and
// behind the hit along the ray.
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

// Records the crossing of one ray. The surface that light meets becomes the ray's hit.
static inline void note_crossing(const scene_buffers *scene, const crossed_solids *all,
                                 lane_int media, int lane, closest *hit, crossing *c)
{
    const media_sides sides = cross_all(scene, media, all);
    const bool by_other = all->other.place >= 0;
    LANE_INT(c->before, lane) = sides.before;
    LANE_INT(c->beyond, lane) = sides.beyond;
    LANE_INT(c->lost, lane) = sides.lost;
    LANE_INT(c->gone, lane) =
        !by_other && scene->media[top_medium(scene, sides.before)].material ==
                         scene->media[top_medium(scene, sides.beyond)].material;
    LANE_INT(c->several, lane) = all->count > (by_other ? 0 : 1);
    const crossed_solid *met = shown_of(scene, all, &sides);
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

// Finds the media on both sides of the places that the rays in `met` meet, and the visible surface
// there. *hit and *t then describe this surface.
static inline surface find_surface_in_place(const scene_buffers *scene, const path *ray, mask met,
                                            closest *hit, triangle *t)
{
    surface s = find_surface(scene, ray, hit, t);
    if (!HAS(OVERLAPS)) {
        return s;
    }
    const packet p = packet_of_paths(ray);
    const real reach = reach_of_place(scene, &s, hit->t);
    const real cosine = fabs(dot3(s.geometric_normal, ray->direction));
    const real depth = reach / LARGER(cosine, real_of(CROSSING_SLACK));
    const lanes_int outside = SELECT(s.outside, int_of(1), int_of(0));
    crossing c = {ray->media, ray->media, int_of(0), int_of(0), int_of(0), int_of(0), false};
    // Find the crossing of each ray.
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
    // Load the surfaces again if a ray now meets another one.
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
