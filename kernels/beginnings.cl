// Applies rule 5 to eyes inside solids. A path begins inside the solids that its ray, going
// straight on, would leave before it enters them. A walk along the ray finds them. Surfaces at the
// position of the eye do not count as met: a ray that starts on a solid's face and runs inwards
// begins inside.
#if GLINT_INSIDE

// The largest number of surfaces that a walk passes.
#define WALKED_MAX 256

// Adds the solids to `begun` that a walk was inside of from the start: entries of `before` that
// `media` lacks. A walk leaves solids in their order, the innermost first.
static inline void note_begun(const scene_buffers *scene, lanes_int media, lanes_int before,
                              int lane, int *count, lanes_int *begun)
{
    lane_int more = LANE_INT(before, lane), known = LANE_INT(media, lane);
    for (; more != 0; more >>= scene->media_bits) {
        const lane_int medium = more & medium_mask(scene);
#if GLINT_OVERLAPS
        if (HAS(OVERLAPS)) {
            if (!remove_medium(scene, &known, medium)) {
                lane_int sorted = LANE_INT(*begun, lane);
                insert_medium(scene, &sorted, medium);
                LANE_INT(*begun, lane) = sorted;
            }
            continue;
        }
#endif
        bool is_known = false;
        for (lane_int left = known; left != 0; left >>= scene->media_bits) {
            is_known |= (left & medium_mask(scene)) == medium;
        }
        if (!is_known && *count < scene->media_capacity) {
            LANE_INT(*begun, lane) |= medium << (scene->media_bits * (*count)++);
        }
    }
}

// The media on both sides of the walk's next surface. If the walk leaves a solid that it has not
// entered, the solid counts as before the surface.
static inline void walk_media(const scene_buffers *scene, const surface *s, lanes_int media,
                              lanes_int *before, lanes_int *beyond)
{
#if GLINT_OVERLAPS
    if (HAS(OVERLAPS)) {
        *before = s->media_before;
        *beyond = s->media_beyond;
        return;
    }
#endif
    mask lost;
    const mask solid = HAS_FLAG(*s, GLINT_MATERIAL_SOLID);
    const lanes_int entered = enter_medium(scene, media, s->medium, &lost);
    const lanes_int left = leave_medium(scene, media, s->medium);
    *before = SELECT(solid & !s->outside & (left == media), entered, media);
    *beyond = SELECT(solid, SELECT(s->outside, entered, left), media);
}

// Makes one step of a group's walk, past the hits of the rays in `met`.
static inline void walk_past(const scene_buffers *scene, path *ray, closest *hit, mask met,
                             mask *first, lanes_int *places, int *counts, lanes_int *begun)
{
    triangle triangles = load_triangles(scene, SELECT(met, hit->place, int_of(0)), met);
    const lanes_int place = hit->place;
    const surface s = find_surface_in_place(scene, ray, met, hit, &triangles);
    const real height = hit->t * fabs(dot3(s.geometric_normal, ray->direction));
    const mask here = met & *first & (height <= reach_of_place(scene, &s, hit->t));
    *places = SELECT(met & *first & !here, place, *places);
    lanes_int before, beyond;
    walk_media(scene, &s, ray->media, &before, &beyond);
    for (uint left = mask_bits(met & !here); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left);
        note_begun(scene, ray->media, before, lane, &counts[lane], begun);
    }
    ray->media = SELECT(met & !here, beyond, ray->media);
    *first = *first & !(met & !here);
    path past = *ray;
    start_off_surface(scene, &past, &s, -s.offset);
    ray->origin = select3(met, past.origin, ray->origin);
#if LOCAL_RAYS
    ray->origin_low = select3(met, past.origin_low, ray->origin_low);
#endif
    ray->from = SELECT(met, place, ray->from);
}

// Sets the media that paths begin in, and the first hits of their primary rays.
static inline void find_beginnings(const scene_buffers *scene, paths *all, primary *firsts)
{
    path walkers[PATH_GROUPS];
    mask active[PATH_GROUPS], first[PATH_GROUPS];
    int counts[PATH_GROUPS][GLINT_WIDTH];
    closest hits[PATH_GROUPS];
    for (int g = 0; g < PATH_GROUPS; g++) {
        walkers[SLOT(g)] = all->ray[SLOT(g)];
        active[SLOT(g)] = all->active[SLOT(g)];
        first[SLOT(g)] = mask_all();
        firsts[SLOT(g)].places = int_of(-1);
        for (int lane = 0; lane < GLINT_WIDTH; lane++) {
            counts[SLOT(g)][lane] = 0;
        }
    }
    for (int walked = 0; walked < WALKED_MAX && any_active(active); walked++) {
        trace_groups(scene, walkers, active, hits);
        for (int g = 0; g < PATH_GROUPS; g++) {
            closest *hit = &hits[SLOT(g)];
            active[SLOT(g)] = active[SLOT(g)] & (hit->place >= (lane_int)0);
            if (any_lane(active[SLOT(g)])) {
                walk_past(scene, &walkers[SLOT(g)], hit, active[SLOT(g)], &first[SLOT(g)],
                          &firsts[SLOT(g)].places, counts[SLOT(g)], &all->ray[SLOT(g)].media);
            }
        }
    }
}

#endif
