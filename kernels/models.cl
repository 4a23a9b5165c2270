// Divides light at a surface by its models: metal, glass, rough lobes, paint, sheen (rules 3 to 6, 11
// and 17). scatter.cl puts the models together.

typedef struct scattering {
    real3 emitted; // radiance that the path gathers here: emission, paint, unlit colour
    real3 reflected, reflected_weight; // unit direction; factors of R, G, B
    lanes_int media_reflected;
    // For glass:
    real3 transmitted, transmitted_weight;
    lanes_int media_transmitted; // the stack of media beyond the surface
    mask total_reflection;
    real eta, bend; // of the transmitted ray, see leave_surface
#if GLINT_ROUGH
    mask rough;                   // reflects a lobe
    real3 lobe_base, lobe_edge;   // how much of lobe_light's two parts comes by paths
    real3 matte_base, matte_edge; // and how much comes without a path
    real lobe_weight;             // weight of the whole lobe, with and without paths
    lobe_parts albedo;            // what lobe_light's two parts are if all is white
#endif
#if GLINT_SHEEN
    real3 sheen; // factor of the sheen's light
#endif
#if GLINT_CLEARCOAT
    mask coat_apart;  // `transmitted` holds the coat's reflection; else `reflected` has it
    real coat_weight; // weight of the coat's reflection
#if GLINT_ROUGH
    mask coat_rough; // the clear coat reflects a lobe
    real coat_gain;  // weight of its edge part; its base part weighs F0 times as much
    lobe_parts coat_albedo;
#endif
#endif
} scattering;

// F0 of a dielectric per colour: its reflectance at right angles. KHR_materials_specular colours
// it.
static inline real3 specular_at_right_angles(const scene_buffers *scene, const surface *s, real f0)
{
#if GLINT_SPECULAR
    if (HAS(SPECULAR)) {
        const real3 one = real3_of(real_of(1), real_of(1), real_of(1));
        return smaller3(scale(s->specular_color, f0), one);
    }
#endif
    return real3_of(f0, f0, f0);
}

// The reflectance of a metal per colour.
static inline real3 reflect_from_metal(const scene_buffers *scene, const surface *s)
{
    real3 reflected = metal_reflectance(s->base_color, s->cosine, HAS(FRESNEL));
#if GLINT_IRIDESCENCE
    reflected = reflect_by_film(scene, s, reflected, real_of(1), film_roots(s->base_color),
                                real_of(1), s->cosine);
#endif
    return reflected;
}

// The two sides of a dielectric surface, seen from the side of its normal.
typedef struct sides {
    real eta;    // the outer medium's index of refraction over the inner one's
    real outer;  // the outer medium's index of refraction
    real cosine; // of light's angle to the normal in the outer medium
    bool of_paint;
} sides;

// Above the index 2 + √3 Fresnel's term falls below F0 before it rises. Its inverse:
#define HIGH_INDEX_ETA R(0.26794919243112270647)

// Rule 6: how far the coat of paint has Schlick's edge instead of Fresnel's, by the index of
// refraction: not at all up to 2 + √3, and wholly from 6 on.
static inline real schlick_share(const sides *at)
{
    const scalar inverse = R(1.0) / (HIGH_INDEX_ETA - R(1.0) / R(6.0));
    const real share = (HIGH_INDEX_ETA - at->eta) * inverse;
    return at->of_paint ? SMALLER(LARGER(share, real_of(0)), real_of(1)) : real_of(0);
}

// The reflectance of a dielectric per colour; `reflectance` is its Fresnel term. With
// KHR_materials_specular this term sets the position between the coloured F0 and 1, and `specular`
// scales the result.
static inline real3 specular_reflectance(const scene_buffers *scene, const surface *s,
                                         real reflectance, const sides *at)
{
    const real root = (R(1.0) - at->eta) / (R(1.0) + at->eta), f0 = root * root;
    const real m = R(1.0) - at->cosine, m2 = m * m, edge = m2 * m2 * m;
    const real share = schlick_share(at);
    if (at->of_paint) {
        const real schlick = fused(R(1.0) - f0, edge, f0);
        reflectance = fused(share, schlick - reflectance, reflectance);
    }
    real3 reflected = real3_of(reflectance, reflectance, reflectance);
    real3 roots = real3_of(root, root, root); // of the base beneath a film
    real weight = real_of(1);
#if GLINT_SPECULAR
    if (HAS(SPECULAR)) {
        // Fresnel's term of a high index falls below F0.
        const mask below = reflectance < f0;
        real way = (reflectance - f0) / (R(1.0) - f0);
        way = SELECT(share < R(1.0), way, edge); // 1 − F0 has few digits
        const real3 from = specular_at_right_angles(scene, s, f0);
        const real3 rest = real3_of(R(1.0) - from.x, R(1.0) - from.y, R(1.0) - from.z);
        weight = s->specular;
        const real3 less = scale(from, reflectance / SELECT(below, f0, real_of(1)));
        reflected = scale(select3(below, less, scale_add(rest, way, from)), weight);
#if GLINT_IRIDESCENCE
        const real sign = SELECT(root < R(0.0), real_of(-1), real_of(1));
        roots = scale(film_roots(from), sign);
#endif
    }
#endif
#if GLINT_IRIDESCENCE
    reflected = reflect_by_film(scene, s, reflected, weight, roots, at->outer, at->cosine);
#endif
    return reflected;
}

// specular_reflectance of paint or of glass that light meets from empty space.
static inline real3 specular_from_space(const scene_buffers *scene, const surface *s, bool of_paint)
{
    const sides at = {R(1.0) / s->ior, real_of(1), s->cosine, of_paint};
    return specular_reflectance(scene, s, surface_reflectance(s->cosine, s->ior), &at);
}

// Rule 4, glass: reflectance and transmitted direction. A thin wall is one interface from empty
// space on both sides, and light passes straight through it.
static inline real glass_reflectance(const scene_buffers *scene, const surface *s, real3 v,
                                     real eta, real3 *transmitted, real *bend,
                                     mask *total_reflection)
{
    real squared = transmitted_cosine_squared(s->cosine, eta);
    *total_reflection = !(squared >= R(0.0));
    real cosine_t = sqrt(SELECT(*total_reflection, real_of(0), squared));
    real reflectance =
        HAS(FRESNEL) ? dielectric_reflectance(s->cosine, cosine_t, eta) : real_of(0);
    reflectance = SELECT(*total_reflection, real_of(1), reflectance);
    *bend = fused(eta, s->cosine, -cosine_t);
    *transmitted = fold_to_side(refract_direction(v, s->normal, s->cosine, eta, cosine_t),
                                s->geometric_normal, R(-1.0));
    *transmitted = renormalized(*transmitted);
    return reflectance;
}

// Rule 5: if a path meets a back face with an empty stack, it began inside that solid.
static inline lanes_int media_met_in(const scene_buffers *scene, const surface *s, mask solid,
                                     lanes_int media)
{
#if GLINT_OVERLAPS
    if (HAS(OVERLAPS)) {
        return s->media_before;
    }
#endif
    return SELECT(solid & !s->outside & (media == (lane_int)0), s->medium, media);
}

// Rule 5: the media on both sides of a solid's surface. Sets the stacks of both branches and the
// outer medium's index of refraction, and returns η = n_i/n_t.
static inline real cross_solid(const scene_buffers *scene, const surface *s, mask solid,
                               lanes_int *media, lanes_int *beyond, real *outer, mask *lost)
{
    *media = media_met_in(scene, s, solid, *media);
#if GLINT_OVERLAPS
    if (HAS(OVERLAPS)) {
        *beyond = s->media_beyond;
        *lost = s->media_lost;
    } else
#endif
    {
        lanes_int entered = enter_medium(scene, *media, s->medium, lost);
        lanes_int left = leave_medium(scene, *media, s->medium);
        *beyond = SELECT(solid, SELECT(s->outside, entered, left), *media);
        *lost = *lost & solid & s->outside;
    }
    real n_i = medium_ior(scene, medium_on_top(scene, *media), IOR_STEP(s));
    real n_t = medium_ior(scene, medium_on_top(scene, *beyond), IOR_STEP(s));
    *outer = SELECT(s->outside, n_i, n_t);
    return n_i / n_t;
}

// Rule 4, glass: adds the light that glass reflects and transmits, weighted by `share`.
static inline void scatter_glass(const scene_buffers *scene, const surface *s, real3 v, real share,
                                 lanes_int *media, scattering *out, mask *media_lost)
{
    real eta = R(1.0) / s->ior, outer = real_of(1);
    mask within = mask_none();
    out->media_transmitted = *media;
    if (GLINT_SOLID) {
        const mask solid = HAS_FLAG(*s, GLINT_MATERIAL_SOLID);
        real outer_of_solid;
        const real solid_eta = cross_solid(scene, s, solid, media, &out->media_transmitted,
                                           &outer_of_solid, media_lost);
        eta = SELECT(solid, solid_eta, eta);
        outer = SELECT(solid, outer_of_solid, outer);
        within = solid & !s->outside;
    }
    // Find the reflectance and the transmitted direction, then the reflected light per colour.
    const real reflectance =
        glass_reflectance(scene, s, v, eta, &out->transmitted, &out->bend, &out->total_reflection);
    const real3 all = real3_of(share, share, share);
    // If light comes from within, its angle outside is the transmitted ray's.
    const sides at = {SELECT(within, R(1.0) / eta, eta), outer,
                      SELECT(within, fused(eta, s->cosine, -out->bend), s->cosine), false};
    real3 reflected = scale(specular_reflectance(scene, s, reflectance, &at), share);
    reflected = select3(out->total_reflection, all, reflected);
    if (GLINT_THIN_WALL) {
        const mask thin = HAS_FLAG(*s, GLINT_MATERIAL_THIN);
        out->transmitted = select3(thin, negate(v), out->transmitted);
        out->bend = SELECT(thin, real_of(0), out->bend);
        eta = SELECT(thin, real_of(1), eta);
    }
    out->eta = eta;
    out->reflected_weight = add(out->reflected_weight, reflected);
    out->transmitted_weight = scale(s->base_color, share - largest3(reflected));
    out->total_reflection = out->total_reflection & (share > R(0.0));
}

#if GLINT_ROUGH
// The share of a coat's reflection that comes by a path.
static inline real share_of_path(real roughness)
{
    const scalar inverse = (scalar)(1 / (GLINT_COAT_MATTE - GLINT_COAT_SHARP));
    const real left = ((scalar)GLINT_COAT_MATTE - roughness) * inverse;
    return SMALLER(LARGER(left, real_of(0)), real_of(1));
}

// The light that microfacets reflect to other facets, relative to the light that they reflect at
// once. A lobe that gains this times F0 also has the light of multiple scattering (Turquin,
// Practical multiple scattering compensation for microfacet models, 2019). 0 if the frame asks for
// no compensation.
static inline real light_lost(const scene_buffers *scene, const lobe_parts *albedo)
{
    return scene->cells.compensation *
           (R(1.0) / LARGER(albedo->base + albedo->edge, real_of(R(0.1))) - R(1.0));
}

// Rule 11: metal and the coat of paint as lobes; `paint` is the share of paint. Sets the weights of
// the light's parts. Returns the share of light that passes the coat.
static inline real scatter_lobe(const scene_buffers *scene, const surface *s, real paint,
                                scattering *out)
{
    // Find the albedo of the lobe.
    const real zero = real_of(0);
    lobe_parts albedo = find_albedo(scene, s->cosine, s->roughness, out->rough);
#if GLINT_BRUSHED
    const mask brushed = out->rough & (s->anisotropy > R(0.0));
    if (HAS(BRUSHED) && any_lane(brushed)) {
        const lobe_parts found =
            brushed_albedo(s->cosine, s->along_cosine, s->roughness, s->anisotropy);
        albedo.base = SELECT(brushed, found.base, albedo.base);
        albedo.edge = SELECT(brushed, found.edge, albedo.edge);
    }
#endif
    out->albedo = albedo;
    // Weigh the metal.
    const real lost = light_lost(scene, &albedo);
    const real3 one = real3_of(real_of(1), real_of(1), real_of(1));
    real3 tint = GLINT_TINT ? s->base_color : one;
#if GLINT_IRIDESCENCE
    tint = film_of_lobe(scene, s, tint);
#endif
    const real3 metal = scale(scale_add(tint, lost, one), s->metallic);
    out->lobe_base = multiply(tint, metal);
    out->lobe_edge = HAS(FRESNEL) ? metal : out->lobe_base;
    out->matte_base = out->matte_edge = real3_of(zero, zero, zero);
    // Add the coat of paint, divided into light by a path and light without a path.
    real coat = zero;
    if (GLINT_PAINT && HAS(FRESNEL)) {
        const real root = (s->ior - R(1.0)) / (s->ior + R(1.0));
        real3 f0 = specular_at_right_angles(scene, s, root * root);
#if GLINT_IRIDESCENCE
        f0 = film_of_lobe(scene, s, f0);
#endif
        real3 gain = scale_add(f0, lost, one);
#if GLINT_SPECULAR
        gain = HAS(SPECULAR) ? scale(gain, s->specular) : gain;
#endif
        const real3 whole_edge = scale(gain, paint), own = multiply(whole_edge, f0);
        const real by_path = share_of_path(s->roughness);
        const real3 base = scale(own, by_path), edge = scale(whole_edge, by_path);
        const real3 edges = real3_of(albedo.edge, albedo.edge, albedo.edge);
        coat = largest3(multiply(gain, scale_add(f0, albedo.base, edges)));
        out->lobe_base = add(out->lobe_base, base);
        out->lobe_edge = add(out->lobe_edge, edge);
        out->matte_base = subtract(own, base);
        out->matte_edge = subtract(whole_edge, edge);
    }
    // Find the weights of the whole lobe.
    const real3 weight =
        scale_add(out->lobe_base, albedo.base, scale(out->lobe_edge, albedo.edge));
    out->reflected_weight = select3(out->rough, weight, out->reflected_weight);
    const real3 matte =
        scale_add(out->matte_base, albedo.base, scale(out->matte_edge, albedo.edge));
    out->lobe_weight = (largest3(weight) + largest3(matte)) / (albedo.base + albedo.edge);
    return R(1.0) - coat;
}
#endif

// Rule 6, paint: adds the environment's irradiance that paint reflects, weighted by `share` (the
// map holds E(n)/π). Smooth paint also reflects as a mirror.
static inline void scatter_paint(const scene_buffers *scene, const surface *s, real3 irradiance,
                                 real share, real kept, scattering *out)
{
    if (HAS(GLOSS)) {
        mask smooth = HAS_FLAG(*s, GLINT_MATERIAL_GLOSS) &
                      (s->roughness < (scalar)GLINT_ROUGHNESS_LEAST);
#if GLINT_ROUGH
        smooth = smooth & !out->rough;
#endif
#if GLINT_FACETS
        smooth = smooth | s->facet.there;
#endif
        const real3 reflectance = specular_from_space(scene, s, true);
        const real3 gloss = scale(reflectance, SELECT(smooth, share, real_of(0)));
        out->reflected_weight = add(out->reflected_weight, gloss);
        kept = SELECT(smooth, R(1.0) - largest3(reflectance), kept);
    }
    real3 sent = multiply(s->base_color, irradiance);
#if GLINT_DIFFUSE_TRANSMISSION
    if (HAS(DIFFUSE_TRANSMISSION)) {
        sent = scale_add(subtract(multiply(s->through_color, s->behind), sent), s->through, sent);
    }
#endif
    out->emitted = scale(sent, share * kept);
}

// Rule 6, the lecture's blend: replaces the results of the other models.
static inline void scatter_blend(const surface *s, real3 irradiance, scattering *out)
{
    const mask blended = HAS_FLAG(*s, GLINT_MATERIAL_BLEND);
    const real3 matte = scale(multiply(s->base_color, irradiance), R(1.0) - s->blend);
    out->emitted = select3(blended, matte, out->emitted);
    const real3 mirrored = real3_of(s->blend, s->blend, s->blend);
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    out->reflected_weight = select3(blended, mirrored, out->reflected_weight);
    out->transmitted_weight = select3(blended, zero, out->transmitted_weight);
}

#if GLINT_CLEARCOAT || GLINT_ALPHA || GLINT_SHEEN
// Scales the result so far: only the share `left` remains.
static inline void leave_share(real left, scattering *out)
{
    out->emitted = scale(out->emitted, left);
    out->reflected_weight = scale(out->reflected_weight, left);
    out->transmitted_weight = scale(out->transmitted_weight, left);
#if GLINT_ROUGH
    out->lobe_base = scale(out->lobe_base, left);
    out->lobe_edge = scale(out->lobe_edge, left);
    out->matte_base = scale(out->matte_base, left);
    out->matte_edge = scale(out->matte_edge, left);
    out->lobe_weight *= left;
#endif
#if GLINT_SHEEN
    out->sheen = scale(out->sheen, left);
#endif
}
#endif

#if GLINT_SHEEN
// Rule 17: sheen above metal and paint. They get the light that sheen leaves.
static inline void scatter_from_sheen(const scene_buffers *scene, const surface *s,
                                      scattering *out)
{
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    const real most = largest3(s->sheen_color);
    const mask there = most > R(0.0);
    const scalar narrow = (scalar)GLINT_ROUGHNESS_NARROW;
    const real roughness = (LARGER(s->sheen_roughness, real_of(narrow)) - narrow) *
                           (R(1.0) / (R(1.0) - narrow));
    const lobe_parts albedo =
        read_albedo(scene->cells.values + GLINT_ALBEDO_VALUES, roughness, sqrt(s->cosine), there);
    const real left = LARGER(fused(-most, albedo.base, real_of(1)), real_of(0));
    out->sheen = zero;
    leave_share(SELECT(there, left, real_of(1)), out);
    out->sheen = select3(there, s->sheen_color, zero);
#if GLINT_LIGHTS
    if (HAS(LIGHTS)) {
        out->emitted = add(out->emitted, multiply(out->sheen, s->sheen_shine));
    }
#endif
}
#endif
