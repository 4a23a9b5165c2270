// Finds the light of rough surfaces' lobes on paths (rule 11 of docs/light_transport.md).
#if GLINT_ROUGH

// A lobe, and the weights of its light's parts.
typedef struct wanted_lobe {
    mask there;
    lobe_shape shape; // with the surface's normal, n·v ≥ 0
    real weight;                // weight of the whole lobe
    real3 path_base, path_edge; // by a path
    real3 matte_base, matte_edge; // without a path
    lobe_parts albedo;            // what both parts are if all is white
} wanted_lobe;

// The light of the environment that a lobe shows.
typedef struct seen_lobe {
    real3 matte; // without a path
    // At its end the reflected path takes this light, and the environment's times `shown`.
    real3 held;
    real shown;
} seen_lobe;

static inline seen_lobe no_lobe(void)
{
    const real3 none = real3_of(real_of(0), real_of(0), real_of(0));
    const seen_lobe seen = {none, none, real_of(1)};
    return seen;
}

static inline wanted_lobe lobe_of_surface(const surface *s, const scattering *out, mask met)
{
    const wanted_lobe w = {met & out->rough, shape_of_surface(s), out->lobe_weight,
                           out->lobe_base,   out->lobe_edge,      out->matte_base,
                           out->matte_edge,  out->albedo};
    return w;
}

#if GLINT_SHEEN
static inline wanted_lobe lobe_of_sheen(const surface *s, const scattering *out, mask met)
{
    const real3 none = real3_of(real_of(0), real_of(0), real_of(0));
    const real weight = largest3(out->sheen);
    const lobe_parts unused = {real_of(0), real_of(0)}; // sheen is not scaled
    const wanted_lobe w = {met & (weight > R(0.0)), shape_of_sheen(s), weight, none, none,
                           out->sheen, none, unused};
    return w;
}
#endif

// a/b, or 0 if b is 0.
static inline real ratio_of(real a, real b)
{
    const mask there = b > R(0.0);
    return SELECT(there, a / SELECT(there, b, real_of(1)), real_of(0));
}

// Scales the light of lobes that are seen at a slant so that it would be their albedo if all were
// white. Such lobes may be narrower than the cells. Then only the ratio of the cells' weights
// counts. Of other lobes the sum is better: cells have their weights at the centroids of their
// light, which is right for the light alone.
static inline void scale_to_albedo(const lobe *l, const lobe_parts *albedo, lobe_light *light)
{
    if (!l->is_scaled) {
        return;
    }
    const real share = scaled_share(l);
    const real base = ratio_of(albedo->base, light->white_base);
    const real edge = ratio_of(albedo->edge, light->white_edge);
    light->base = scale(light->base, fused(share, base - R(1.0), real_of(1)));
    light->edge = scale(light->edge, fused(share, edge - R(1.0), real_of(1)));
}

// Rule 11, for the rays that have a lobe.
static inline seen_lobe see_lobe(const scene_buffers *scene, const glint_frame_record *frame,
                                 const wanted_lobe *w, const path *ray)
{
    const real3 none = real3_of(real_of(0), real_of(0), real_of(0));
    seen_lobe seen = no_lobe();
    if (!any_lane(w->there)) {
        return seen;
    }
    lobe_shape shape = w->shape;
    shape.normal = turn_into_environment(frame, shape.normal);
#if GLINT_BRUSHED
    shape.along = turn_into_environment(frame, shape.along);
#endif
    const real3 v = turn_into_environment(frame, negate(ray->direction));
    // Integrate the lobe over the environment.
    const real share = share_of_lobe(scene, &shape);
    const real least = real_of((scalar)GLINT_ROUGHNESS_NARROW);
    const lobe l = find_lobe(scene, &shape, v, LARGER(shape.roughness, least),
                             largest3(ray->weight) * w->weight);
    lobe_light light = integrate_lobe(scene, &l, w->there);
    scale_to_albedo(&l, &w->albedo, &light);
    // Divide the light into the part without a path and the part by a path.
    const real3 matte =
        add(multiply(w->matte_base, light.base), multiply(w->matte_edge, light.edge));
    const real3 by_path =
        add(multiply(w->path_base, light.base), multiply(w->path_edge, light.edge));
    const real3 weight = scale_add(w->path_base, w->albedo.base,
                                   scale(w->path_edge, w->albedo.edge));
    const real3 held = real3_of(ratio_of(by_path.x, weight.x), ratio_of(by_path.y, weight.y),
                                ratio_of(by_path.z, weight.z));
    seen.matte = select3(w->there, multiply(ray->weight, matte), none);
    seen.held = select3(w->there, scale(held, share), none);
    seen.shown = SELECT(w->there, R(1.0) - share, real_of(1));
    return seen;
}

#if GLINT_CLEARCOAT
static inline wanted_lobe lobe_of_coat(const surface *s, const scattering *out, mask met)
{
    const real edge = s->clearcoat * out->coat_gain, base = edge * CLEARCOAT_F0;
    const real share = share_of_path(s->clearcoat_roughness);
    const real3 bases = real3_of(base, base, base), edges = real3_of(edge, edge, edge);
    wanted_lobe w;
    w.there = met & out->coat_rough;
    w.shape = shape_of_coat(s);
    w.weight = edge;
    w.path_base = scale(bases, share);
    w.path_edge = scale(edges, share);
    w.matte_base = subtract(bases, w.path_base);
    w.matte_edge = subtract(edges, w.path_edge);
    w.albedo = out->coat_albedo;
    return w;
}

// Joins the coat's lobe to the lobe of the layers below, if both reflections take the same
// direction. Each contributes its share of the environment's light.
static inline void join_lobes(const surface *s, const scattering *out, const seen_lobe *coat,
                              seen_lobe *below)
{
    const mask joined = are_coats_joined(s, out);
    const real3 whole = out->reflected_weight;
    const real share = ratio_of(out->coat_weight, largest3(whole));
    const real3 shares = real3_of(ratio_of(out->coat_weight, whole.x),
                                  ratio_of(out->coat_weight, whole.y),
                                  ratio_of(out->coat_weight, whole.z));
    const real3 more = multiply(subtract(coat->held, below->held), shares);
    below->held = select3(joined, add(below->held, more), below->held);
    below->shown = SELECT(joined, fused(share, coat->shown - below->shown, below->shown),
                          below->shown);
}
#endif

#if CARRIES_CONES
// Widens the cone of the reflected ray by the lobe's width, about 2α. Below ROUGHNESS_NARROW the
// ray shows a mirror's light, and the cone stays as it is.
static inline real widened_by_lobe(real roughness, mask rough, real spread)
{
    const real width = R(2.0) * roughness * roughness;
    const mask wide = rough & (roughness >= (scalar)GLINT_ROUGHNESS_NARROW);
    return SELECT(wide, joined_width(spread, width), spread);
}
#endif
#endif
