// What paths bring of the lobes of rough surfaces (rule 11 of ARCHITECTURE.md, Light transport).
#if GLINT_ROUGH

// What lobes show of the environment.
typedef struct seen_lobe {
    real3 matte; // without a path
    real3 held;  // that the reflected path brings where it ends
    real shown;  // how much of the environment's light it brings there beside that
} seen_lobe;

// Rule 11, for the rays in `met`.
static inline seen_lobe see_lobe(const scene_buffers *scene, const glint_frame_record *frame,
                                 const surface *s, const scattering *out, mask met,
                                 const path *ray)
{
    const mask rough = met & out->rough;
    const real3 none = real3_of(real_of(0), real_of(0), real_of(0));
    seen_lobe seen = {none, none, real_of(1)};
    if (!any_lane(rough)) {
        return seen;
    }
    const real3 normal = turn_into_environment(frame, s->normal);
    const real3 v = turn_into_environment(frame, negate(ray->direction));
    const real share = share_of_lobe(s->roughness);
    const real least = real_of((scalar)GLINT_ROUGHNESS_NARROW);
    const lobe l = find_lobe(&scene->cells, normal, v, s->cosine, LARGER(s->roughness, least),
                             largest3(ray->weight) * out->lobe_weight);
    const lobe_light light = integrate_lobe(scene, &l, rough);
    const real3 matte =
        add(multiply(out->matte_base, light.base), multiply(out->matte_edge, light.edge));
    const real3 by_path =
        add(multiply(out->lobe_base, light.base), multiply(out->lobe_edge, light.edge));
    seen.matte = select3(rough, multiply(ray->weight, matte), none);
    seen.held = select3(rough, multiply(ray->weight, scale(by_path, share)), none);
    seen.shown = SELECT(rough, R(1.0) - share, real_of(1));
    return seen;
}

#if CARRIES_CONES
// A lobe is about 2α wide, and so is what the reflected ray sees; but not below ROUGHNESS_NARROW,
// where it shows what a mirror does.
static inline real widened_by_lobe(const surface *s, mask rough, real spread)
{
    const real width = R(2.0) * s->roughness * s->roughness;
    const mask wide = rough & (s->roughness >= (scalar)GLINT_ROUGHNESS_NARROW);
    return SELECT(wide, joined_width(spread, width), spread);
}
#endif
#endif
