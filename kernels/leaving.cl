// Creates the branches that leave a surface: their start, the data they carry, and early ends.

// A branch that leaves the surface: a ray along `direction`, on the viewer's side or `beyond`.
static inline path make_branch(const scene_buffers *scene, const path *ray, const surface *s,
                               const closest *hit, real3 direction, mask beyond)
{
    path branch = *ray;
    branch.direction = direction;
    branch.met = ray->met + (lane_int)1;
    if (HAS(CONVEX_SOLID)) {
        const mask leaves = (s->outside & !beyond) | (beyond & !s->outside);
        branch.looked_up = SELECT(leaves, int_of(ESCAPES), int_of(0));
    }
    if (HAS_PLACES) {
        const real offset = SELECT(beyond, -s->offset, s->offset);
        start_off_surface(scene, &branch, s, offset);
        branch.from = hit->place;
    }
#if GLINT_ABSORPTION
    branch.travelled = real_of(0);
#endif
    return branch;
}

// Rule 7: finds branches among `exists` that have met the largest number of surfaces, or that weigh
// too little. Counts the light that this truncation leaves out.
static inline mask ended(const glint_frame_record *frame, real weight, lanes_int met, mask exists,
                         const pixels *pixels, tally *tally)
{
    mask deep = exists & (met >= (lane_int)frame->depth);
    mask light = exists & !deep & (weight < (scalar)frame->min_weight);
    count_cut(tally, pixels, deep, weight, BY_DEPTH);
    count_cut(tally, pixels, light, weight, BY_MIN_WEIGHT);
    count_truncated(tally, pixels, frame->depth_counts != 0 ? deep | light : light, weight);
    return deep | light;
}

// The number of surfaces that a path has met; surfaces that it passed through as absent do not
// count.
static inline lanes_int surfaces_met(const path *ray)
{
#if GLINT_ALPHA
    return ray->met - ray->passed;
#else
    return ray->met;
#endif
}

// Ends such branches: they take the environment along their direction. Branches that are already
// looked up without tracing stay unchanged.
static inline void end_branch(const glint_frame_record *frame, path *branch, mask exists,
                              const pixels *pixels, tally *tally)
{
    mask traced = branch->looked_up == (lane_int)0;
    mask ends = ended(frame, largest3(branch->weight), surfaces_met(branch), exists & traced,
                      pixels, tally);
    branch->looked_up = SELECT(ends, int_of(1), branch->looked_up);
}

#if GLINT_FACETS
// The part of a lobe that a branch's direction stands for. `how` holds scaled and bend as in
// leave_surface, and the turn of the branch per turn of a facet.
static inline cone leave_facet(const path *ray, real t, const surface *s, const real how[3])
{
    const real width = width_after(&ray->lobe, t);
    cone lobe = leave_surface(width, ray->lobe.spread, how[0], how[1], s->curvature);
    const real own = joined_width(lobe.spread, how[2] * s->facet.width);
    lobe.spread = SELECT(s->facet.there, own, lobe.spread);
    return lobe;
}
#endif

#if GLINT_ROUGH && CARRIES_CONES
// The spread of a cone reflected by a lobe: the surface's lobe, or the lobe of a coat that takes
// the same direction.
static inline real widened_by_reflection(const surface *s, const scattering *out, real spread)
{
    real roughness = s->roughness;
    mask rough = out->rough;
#if GLINT_CLEARCOAT
    const mask by_coat = are_coats_joined(s, out);
    roughness = SELECT(by_coat, s->clearcoat_roughness, roughness);
    rough = (rough & !by_coat) | (out->coat_rough & by_coat);
#endif
    return widened_by_lobe(roughness, rough, spread);
}
#endif

#if COATS_APART && GLINT_ROUGH
// Hands the lobe of a coat apart to the branch that leaves it.
static inline void leave_coat(const surface *s, const scattering *out, const seen_lobe *coat,
                              path *branch)
{
    const mask apart = out->coat_apart;
    branch->held = select3(apart, coat->held, branch->held);
    branch->shown = SELECT(apart, coat->shown, branch->shown);
#if CARRIES_CONES
    branch->cone.spread = widened_by_lobe(s->clearcoat_roughness, apart & out->coat_rough,
                                          branch->cone.spread);
#endif
}
#endif

#if GLINT_DISPERSION && GLINT_OVERLAPS
// True if the medium on top disperses light. Where two surfaces touch, the hit may be the other
// solid's.
static inline mask do_disperse(const scene_buffers *scene, lanes_int media)
{
    lanes_int does = int_of(0);
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE_INT(does, lane) =
            scene->media[top_medium(scene, LANE_INT(media, lane))].dispersion > 0.0f ? 1 : 0;
    }
    return does != (lane_int)0;
}
#endif

#if GLINT_DISPERSION
// Gives rays the round's wavelength when they first meet a dispersive solid. Each such ray stands
// for the wavelength's shares of R, G and B, times the number of wavelengths, because every
// wavelength has its own rounds.
static inline void disperse(const scene_buffers *scene, const glint_frame_record *frame, mask met,
                            const pixels *pixels, path *ray, surface *s, tally *tally)
{
    const glint_wavelength_record *w = &frame->wavelength[tally->wavelength];
    s->ior_step = w->ior_step;
    mask here = HAS_FLAG(*s, GLINT_MATERIAL_DISPERSIVE);
#if GLINT_OVERLAPS
    if (HAS(OVERLAPS)) {
        here = here | do_disperse(scene, s->media_before) | do_disperse(scene, s->media_beyond);
    }
#endif
    here = here & met & (ray->dispersed == (lane_int)0);
    note_pixels(tally, pixels, here, tally->dispersed);
    const scalar count = frame->wavelengths;
    const real3 share = real3_of(real_of(count * (scalar)w->share[0]),
                                 real_of(count * (scalar)w->share[1]),
                                 real_of(count * (scalar)w->share[2]));
    ray->weight = select3(here, multiply(ray->weight, share), ray->weight);
    ray->dispersed = SELECT(here, int_of(1), ray->dispersed);
}
#endif
