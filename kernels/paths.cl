// Follows paths through the scene, from the primary ray to the environment.

#if GLINT_ABSORPTION
// The weight after absorption along the segment that ends here, in the medium on top of the stack.
static inline real3 absorbed_weight(const scene_buffers *scene, const path *ray, real t)
{
    real3 left = medium_transmittance(scene, medium_on_top(scene, ray->media), t + ray->travelled);
    return multiply(ray->weight, left);
}
#endif

static inline void count_transmissions(const surface *s, mask transmits, tally *tally)
{
    mask solid = HAS_FLAG(*s, GLINT_MATERIAL_SOLID);
    tally->counts[GLINT_COUNT_REFRACTED_IN] += (ulong)count_lanes(transmits & solid & s->outside);
    tally->counts[GLINT_COUNT_REFRACTED_OUT] += (ulong)count_lanes(transmits & solid & !s->outside);
    tally->counts[GLINT_COUNT_TRANSMITTED] += (ulong)count_lanes(transmits & !solid);
}

// Pixels may show the background through surfaces, and the image leaves the background out.
#define SEES_THROUGH (GLINT_ALPHA && GLINT_TRANSPARENT)

// The paths of some of a tile's pixels.
typedef struct paths {
    path ray[PATH_GROUPS];
    mask active[PATH_GROUPS];
    pixels pixels[PATH_GROUPS];
#if GATHERS
    // Light gathered so far without the environment, by the tile's groups of pixels.
    real3 radiance[PATH_GROUPS];
#endif
#if SEES_THROUGH
    real uncovered[PATH_GROUPS]; // share of the background visible past surfaces
#endif
#if GLINT_SPLIT
    branches branches;
#endif
} paths;

#if GATHERS
static inline void gather(const scene_buffers *scene, paths *all, int slot, real3 light, mask lit)
{
    if (!HAS(SPLIT)) { // then a slot's paths belong to the group's pixels
        real3 *own = &all->radiance[slot];
        *own = select3(lit, add(*own, light), *own);
        return;
    }
#if GLINT_SPLIT
    lit = lit & ((light.x != R(0.0)) | (light.y != R(0.0)) | (light.z != R(0.0)));
    for (uint left = mask_bits(lit); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left), pixel = pixel_of(all->pixels[slot], lane);
        real3 *sum = &all->radiance[pixel / GLINT_WIDTH];
        LANE(sum->x, pixel % GLINT_WIDTH) += LANE(light.x, lane);
        LANE(sum->y, pixel % GLINT_WIDTH) += LANE(light.y, lane);
        LANE(sum->z, pixel % GLINT_WIDTH) += LANE(light.z, lane);
    }
#endif
}
#endif

#if SEES_THROUGH
// gather for a single number.
static inline void uncover(const scene_buffers *scene, paths *all, int slot, real share, mask seen)
{
    if (!HAS(SPLIT)) {
        all->uncovered[slot] += SELECT(seen, share, real_of(0));
        return;
    }
#if GLINT_SPLIT
    for (uint left = mask_bits(seen); left != 0; left &= left - 1) {
        const int lane = lowest_bit(left), pixel = pixel_of(all->pixels[slot], lane);
        LANE(all->uncovered[pixel / GLINT_WIDTH], pixel % GLINT_WIDTH) += LANE(share, lane);
    }
#endif
}
#endif

#if GLINT_SPLIT
// Follows both branches of a split, the lighter first. If only one more branch may wait, both are
// looked up and counted as truncated.
static inline void split_path(paths *all, int slot, path *reflected, path *transmitted,
                              mask reflects, mask transmits, tally *tally)
{
    branches *b = &all->branches;
    const pixels *pixels = &all->pixels[slot];
    mask both = reflects & transmits;
    mask full = both & nearly_full(b, pixels);
    if (any_lane(full)) {
        mask unended_r = full & (reflected->looked_up == (lane_int)0);
        mask unended_t = full & (transmitted->looked_up == (lane_int)0);
        count_cut(tally, pixels, unended_r, largest3(reflected->weight), BY_STACK);
        count_cut(tally, pixels, unended_t, largest3(transmitted->weight), BY_STACK);
        count_truncated(tally, pixels, unended_r, largest3(reflected->weight));
        count_truncated(tally, pixels, unended_t, largest3(transmitted->weight));
        reflected->looked_up = SELECT(unended_r, int_of(1), reflected->looked_up);
        transmitted->looked_up = SELECT(unended_t, int_of(1), transmitted->looked_up);
    }
    mask reflected_waits = both & (largest3(reflected->weight) > largest3(transmitted->weight));
    mask transmitted_waits = both & !reflected_waits;
    follow_next(b, reflected, pixels, reflects & !reflected_waits);
    follow_next(b, transmitted, pixels, transmits & !transmitted_waits);
    let_wait(b, reflected, pixels, reflected_waits);
    let_wait(b, transmitted, pixels, transmitted_waits);
}
#endif

#if GLINT_TERMS && GATHERS
// Records the terms of emission and of irradiance separately. The reflected light of an irradiance
// of 1 is found as a difference: the result with irradiance 1, minus the emission.
static inline void note_emission(terms *terms, const scene_buffers *scene, const surface *s,
                                 real3 v, const path *ray, mask met, const pixels *pixels)
{
    const real zero = real_of(0), one = real_of(1);
    lanes_int media = ray->media;
    mask media_lost;
    const real3 emitted =
        scatter(scene, s, v, &media, real3_of(zero, zero, zero), &media_lost).emitted;
    note_constant(terms, pixels, met, multiply(ray->weight, emitted));
    if (NEEDS_IRRADIANCE) {
        media = ray->media;
        const real3 lit =
            scatter(scene, s, v, &media, real3_of(one, one, one), &media_lost).emitted;
        note_terms(terms, pixels, met, s->lit_normal, GLINT_TERM_IRRADIANCE,
                   multiply(ray->weight, subtract(lit, emitted)));
    }
}
#endif

#if GLINT_DIFFUSE_TRANSMISSION
// Rule 18: the light on matte paint from behind, over π.
static inline real3 light_from_behind(const scene_buffers *scene, const glint_frame_record *frame,
                                      const path *ray, const surface *s, lanes_int places,
                                      mask met, ulong *shadow_rays)
{
    const mask there = met & (s->through > R(0.0));
    surface back = *s;
    back.geometric_normal = negate(s->geometric_normal);
    back.lit_normal = negate(s->lit_normal);
    back.normal = negate(s->normal);
    back.base_color = s->through_color;
    real3 light = real3_of(real_of(0), real_of(0), real_of(0));
    if (any_lane(there)) {
        light = find_irradiance(scene, turn_into_environment(frame, back.lit_normal), there);
#if GLINT_LIGHTS
        if (HAS(LIGHTS)) {
            back.direct = real3_of(real_of(0), real_of(0), real_of(0));
            light_surface(scene, ray, &back, places, there, shadow_rays);
        }
#endif
        light = light_on_paint(scene, &back, light);
    }
    return light;
}
#endif

// Scatters the rays in `met`; updates their media and their weights (absorption).
static inline scattering scatter_on_path(const scene_buffers *scene,
                                         const glint_frame_record *frame, const surface *s,
                                         const closest *hit, mask met, path *ray, tally *tally)
{
    real3 irradiance = real3_of(real_of(0), real_of(0), real_of(0));
    if (NEEDS_IRRADIANCE) {
        irradiance = find_irradiance(scene, turn_into_environment(frame, s->lit_normal), met);
    }
    mask media_lost;
    lanes_int media = ray->media;
    const scattering out =
        scatter(scene, s, negate(ray->direction), &media, irradiance, &media_lost);
    ray->media = SELECT(met, media, ray->media);
#if GLINT_ABSORPTION
    if (HAS(ABSORPTION)) {
        ray->weight = select3(met, absorbed_weight(scene, ray, hit->t), ray->weight);
    }
#endif
    tally->counts[GLINT_COUNT_MEDIA_OVERFLOWS] += (ulong)count_lanes(met & media_lost);
    return out;
}

// Shades the rays in `met` of a group and adds the surfaces' emission to their radiance. The branch
// that goes on replaces each ray. Returns the rays that go on.
static inline mask meet_surfaces(const scene_buffers *scene, const glint_frame_record *frame,
                                 closest *hit, triangle *triangles, mask met, int slot, paths *all,
                                 tally *tally)
{
    path *ray = &all->ray[slot];
    // Find the surface, its facet and its wavelength.
    surface s = find_surface_in_place(scene, ray, met, hit, triangles);
#if GLINT_FACETS
    if (HAS(FACETS)) {
        const mask faceted = met & are_faceted(&s);
        note_pixels(tally, &all->pixels[slot], faceted, tally->faceted);
        take_facet(frame, &tally->facets, ray, faceted, &s);
    }
#endif
#if GLINT_DISPERSION
    if (HAS(DISPERSION)) {
        disperse(scene, frame, met, &all->pixels[slot], ray, &s, tally);
    }
#endif
    // Count the surfaces that paths have met.
#if GLINT_ALPHA
    const mask there = met & (s.coverage > R(0.0));
#else
    const mask there = met;
#endif
    const lanes_int depth = surfaces_met(ray) + (lane_int)1;
    tally->deepest = SELECT(there & (depth > tally->deepest), depth, tally->deepest);
#if GLINT_DIAGNOSTICS
    if (HAS(DIAGNOSTICS)) {
        note_surfaces(tally->layers, &all->pixels[slot], there, depth);
    }
#endif
    // Add direct light from the lights, then scatter.
#if GLINT_LIGHTS
    if (HAS(LIGHTS)) {
        light_surface(scene, ray, &s, hit->place, met, &tally->counts[GLINT_COUNT_SHADOW_RAYS]);
    }
#endif
#if GLINT_DIFFUSE_TRANSMISSION
    if (HAS(DIFFUSE_TRANSMISSION)) {
        s.behind = light_from_behind(scene, frame, ray, &s, hit->place, met,
                                     &tally->counts[GLINT_COUNT_SHADOW_RAYS]);
    }
#endif
#if SHADES_VERTICES
    const scattering out = scatter_from_corners(scene, frame, ray, &s, hit, met);
#else
    const scattering out = scatter_on_path(scene, frame, &s, hit, met, ray, tally);
#endif
    // Gather the light that the surface sends, and the light of its lobes.
#if GATHERS
    gather(scene, all, slot, multiply(ray->weight, out.emitted), met);
#endif
#if GLINT_ROUGH
    const wanted_lobe wanted = lobe_of_surface(&s, &out, met);
    seen_lobe seen = see_lobe(scene, frame, &wanted, ray);
    gather(scene, all, slot, seen.matte, met);
#if GLINT_SHEEN
    if (HAS(SHEEN)) {
        const wanted_lobe of_sheen = lobe_of_sheen(&s, &out, met);
        gather(scene, all, slot, see_lobe(scene, frame, &of_sheen, ray).matte, met);
    }
#endif
#if GLINT_CLEARCOAT
    seen_lobe coat = no_lobe();
    if (HAS(CLEARCOAT)) {
        const wanted_lobe of_coat = lobe_of_coat(&s, &out, met);
        coat = see_lobe(scene, frame, &of_coat, ray);
        gather(scene, all, slot, coat.matte, met);
        join_lobes(&s, &out, &coat, &seen);
    }
#endif
#endif
#if GLINT_TERMS && GATHERS
    note_emission(tally->terms, scene, &s, negate(ray->direction), ray, met, &all->pixels[slot]);
#endif
#if CARRIES_CONES
    const real width = width_after(&ray->cone, hit->t);
    const real spread = ray->cone.spread;
#endif

    // Make the reflected branch.
    path reflected = make_branch(scene, ray, &s, hit, out.reflected, mask_none());
    reflected.weight = multiply(ray->weight, out.reflected_weight);
    reflected.media = out.media_reflected;
#if GLINT_ROUGH
    reflected.held = seen.held;
    reflected.shown = seen.shown;
#endif
#if CARRIES_CONES
    reflected.cone = leave_surface(width, spread, real_of(1), real_of(2), s.curvature);
#if GLINT_ROUGH
    reflected.cone.spread = widened_by_reflection(&s, &out, reflected.cone.spread);
#endif
#endif
#if GLINT_FACETS
    if (HAS(FACETS)) {
        real turn_back = real_of(2);
#if GLINT_CLEARCOAT
        turn_back = SELECT(are_coats_joined(&s, &out), real_of(0), turn_back); // it has no facets
#endif
        const real back[3] = {real_of(1), real_of(2), turn_back};
        reflected.lobe = leave_facet(ray, hit->t, &s, back);
    }
#endif
    // A weight of exactly 0 adds nothing. NaN compares false and ends the path.
    mask reflects = met & (largest3(reflected.weight) > R(0.0));
    end_branch(frame, &reflected, reflects, &all->pixels[slot], tally);
    tally->counts[GLINT_COUNT_REFLECTED] += (ulong)count_lanes(reflects);
    if (!TWO_WAYS) { // no surface lets light pass, so no path splits
        assign_path(ray, &reflected, reflects);
        return reflects;
    }
    // Make the transmitted branch.
    mask through = mask_all();
#if COATS_APART
    through = !out.coat_apart;
#endif
    path transmitted = make_branch(scene, ray, &s, hit, out.transmitted, through);
    transmitted.weight = multiply(ray->weight, out.transmitted_weight);
    transmitted.media = out.media_transmitted;
#if CARRIES_CONES
    transmitted.cone = leave_surface(width, spread, out.eta, out.bend, s.curvature);
#endif
#if COATS_APART && GLINT_ROUGH
    if (HAS(CLEARCOAT)) {
        leave_coat(&s, &out, &coat, &transmitted);
    }
#endif
#if GLINT_FACETS
    if (HAS(FACETS)) {
        const real turn = SELECT(HAS_FLAG(s, GLINT_MATERIAL_THIN), real_of(2), out.bend);
        const real on[3] = {out.eta, out.bend, turn};
        transmitted.lobe = leave_facet(ray, hit->t, &s, on);
    }
#endif
#if GLINT_ALPHA
    const mask passes = (s.coverage < R(1.0)) &
                        ((s.coverage == R(0.0)) | !HAS_FLAG(s, GLINT_MATERIAL_THIN));
    transmitted.passed = SELECT(passes, ray->passed + (lane_int)1, ray->passed);
#endif
    mask transmits = met & (largest3(transmitted.weight) > R(0.0));
    end_branch(frame, &transmitted, transmits, &all->pixels[slot], tally);
    // Count both branches, and follow them.
    const mask crosses = HAS(OVERLAPS) ? transmits & there : transmits;
    count_transmissions(&s, crosses & through, tally);
    tally->counts[GLINT_COUNT_REFLECTED] += (ulong)count_lanes(transmits & !through);
    tally->counts[GLINT_COUNT_TOTAL_REFLECTIONS] +=
        (ulong)count_lanes(reflects & out.total_reflection);
#if GLINT_DIAGNOSTICS
    if (HAS(DIAGNOSTICS)) {
        note_total_reflections(tally->layers, &all->pixels[slot], reflects & out.total_reflection);
    }
#endif
#if GLINT_SPLIT
    if (HAS(SPLIT)) {
        split_path(all, slot, &reflected, &transmitted, reflects, transmits, tally);
        return mask_none();
    }
#endif
    assign_path(ray, &transmitted, transmits);
    assign_path(ray, &reflected, reflects);
    return reflects | transmits;
}

// Begins the paths of a group with the primary rays in `active`.
static inline void begin_paths(const glint_frame_record *frame, primary *first, int slot, int group,
                               mask active, paths *all)
{
    all->ray[slot] = primary_rays(frame, first);
    all->active[slot] = active;
    all->pixels[slot] = pixels_of_group(group);
#if GATHERS
    all->radiance[slot] = real3_of(real_of(0), real_of(0), real_of(0));
#endif
#if SEES_THROUGH
    all->uncovered[slot] = real_of(0);
#endif
}

#if GLINT_DIAGNOSTICS
// Records for the layers the faces and the truncation of look-ups. `escaped` marks the rays, and
// `direction` is in the environment's axes.
static inline void note_look_ups(const cube_map *map, real3 direction, const path *ray,
                                 mask escaped, const pixels *pixels, layers *layers)
{
    const cube_point point = find_on_cube(direction, int_of(map->edge), int_of(0));
    note_faces(layers, pixels, escaped, ray->weight, face_of(map, &point));
    note_truncation(layers, pixels, escaped & (ray->looked_up == (lane_int)1), ray->weight);
}
#endif

// The directions in which the environment shows the points that rays reach; `first` as in
// advance_paths.
static inline real3 environment_seen(const glint_frame_record *frame, const path *ray,
                                     const primary *first)
{
    if (!HAS_IN(frame, PROXY)) {
        return ray->direction;
    }
    const real behind =
        first != 0 ? first->length * JOIN(frame->start[0], frame->start[1]) : real_of(0);
    return toward_proxy(frame, ray->origin, ray->direction, behind);
}

#if GLINT_ROUGH
// Gathers the light that the rays in `escaped` hold. Leaves them the weight for the environment's
// light. Returns the rays whose weight is not 0.
static inline mask bring_held(const scene_buffers *scene, paths *all, int slot, mask escaped,
                              tally *tally)
{
    path *ray = &all->ray[slot];
#if GLINT_DIAGNOSTICS
    if (HAS(DIAGNOSTICS)) {
        note_truncation(tally->layers, &all->pixels[slot],
                        escaped & (ray->shown < R(1.0)) & (ray->looked_up == (lane_int)1),
                        scale(ray->weight, R(1.0) - ray->shown));
    }
#endif
    gather(scene, all, slot, multiply(ray->weight, ray->held), escaped & (ray->shown < R(1.0)));
    ray->weight = select3(escaped, scale(ray->weight, ray->shown), ray->weight);
    return escaped & (ray->shown > R(0.0));
}
#endif

// Advances the paths in a slot past their hits. Escaped paths look up the environment; the others
// go on from their surfaces. `first` describes primary rays; it is NULL for other rays.
static inline void advance_paths(const scene_buffers *scene, const glint_frame_record *frame,
                                 const image_space *image, const primary *first, int slot,
                                 closest *hit, paths *all, lookups *later, tally *tally)
{
    mask active = all->active[slot];
    mask met = active & (hit->place >= (lane_int)0);
    mask escaped = active & !met;
#if SEES_THROUGH
    if (HAS(ALPHA) && HAS(TRANSPARENT)) {
        const mask past = escaped & (all->ray[slot].met == all->ray[slot].passed);
        if (first == 0) { // else the pixel shows only background
            uncover(scene, all, slot, all->ray[slot].weight.x, past);
        }
        escaped = escaped & !past;
    }
#endif
#if GLINT_ROUGH
    escaped = bring_held(scene, all, slot, escaped, tally);
#endif
    // Look up the environment for escaped rays.
    if (any_lane(escaped) && !(HAS(TRANSPARENT) && first != 0)) {
        const path *ray = &all->ray[slot];
        const real3 direction = turn_into_environment(frame, environment_seen(frame, ray, first));
        look_up_later(later, scene, ray, direction, escaped, &all->pixels[slot]);
#if GLINT_DIAGNOSTICS
        if (HAS(DIAGNOSTICS)) {
            note_look_ups(&scene->environment, direction, ray, escaped, &all->pixels[slot],
                          tally->layers);
        }
#endif
#if GLINT_TERMS
        note_terms(tally->terms, &all->pixels[slot], escaped, ray->direction, GLINT_TERM_RADIANCE,
                   ray->weight);
#endif
    }
    // Shade the surfaces that the other rays have met.
    active = mask_none();
    if (HAS(GEOMETRY) && any_lane(met)) {
        triangle triangles = load_triangles(scene, hit->place, met);
        if (first != 0) {
            measure_hits(image, &triangles, first->x, first->y, first->length, met, hit);
#if LOCAL_RAYS
            if (HAS(LOCAL_ORIGINS)) {
                measure_nearby(&all->ray[slot], &triangles, met, hit);
            }
#endif
        }
        active = meet_surfaces(scene, frame, hit, &triangles, met, slot, all, tally);
    }
    all->active[slot] = active;
}

// Follows the primary rays in `first`, of several groups, to the ends of their paths.
static inline void follow_paths(const scene_buffers *scene, const glint_frame_record *frame,
                                const image_space *image, const primary *first, paths *all,
                                lookups *later, tally *tally)
{
    closest hits[PATH_GROUPS];
    for (int i = 0; i < PATH_GROUPS; i++) {
        hits[SLOT(i)] = no_hit();
        hits[SLOT(i)].place = first[SLOT(i)].places;
    }
#if GLINT_SPLIT
    if (HAS(SPLIT)) {
        no_branches(&all->branches);
    }
#endif
    for (bool are_primary = true; are_primary || any_active(all->active); are_primary = false) {
        if (!are_primary) {
            trace_groups(scene, all->ray, all->active, hits);
        }
        for (int i = 0; i < PATH_GROUPS; i++) {
            if (any_lane(all->active[SLOT(i)])) {
                advance_paths(scene, frame, image, are_primary ? &first[SLOT(i)] : 0, SLOT(i),
                              &hits[SLOT(i)], all, later, tally);
            }
        }
#if GLINT_SPLIT
        if (HAS(SPLIT)) {
            take_branches(&all->branches, all->ray, all->pixels, all->active);
        }
#endif
    }
}
