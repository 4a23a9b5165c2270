// Divides light at a surface (rules 3 to 6 and 9). It finds the light that the surface adds itself,
// and the weights and directions of the reflected and the transmitted branch.

#if GLINT_ALPHA
// Rule 9: a partly covering surface scatters only the share of its coverage. The rest of the light
// goes straight on, as through a thin wall.
static inline void scatter_covered(const scene_buffers *scene, const surface *s, real3 v,
                                   lanes_int media, scattering *out)
{
    const mask partly = s->coverage < R(1.0);
    const real gone = SELECT(partly, R(1.0) - s->coverage, real_of(0));
    const real left = SELECT(partly, s->coverage, real_of(1));
    leave_share(left, out);
#if GLINT_CLEARCOAT
    if (HAS(CLEARCOAT)) {
        out->coat_weight *= left;
#if GLINT_ROUGH
        out->coat_gain *= left;
#endif
    }
#endif
    out->transmitted_weight = add(out->transmitted_weight, real3_of(gone, gone, gone));
    out->transmitted = select3(partly, negate(v), out->transmitted);
#if GLINT_OVERLAPS
    media = HAS(OVERLAPS) ? s->media_beyond : media;
#endif
    out->media_transmitted = SELECT(partly, media, out->media_transmitted);
    out->total_reflection = out->total_reflection & !partly;
    out->eta = SELECT(partly, real_of(1), out->eta);
    out->bend = SELECT(partly, real_of(0), out->bend);
}
#endif

#if GLINT_FACETS
// Rule 12, rough glass: keeps only the light from facets that no other facet blocks. A thin wall
// transmits the mirror image of its reflection.
static inline void scatter_from_facets(const surface *s, real3 v, scattering *out)
{
    const facet *f = &s->facet;
    if (!any_lane(f->there)) {
        return;
    }
    const real3 r = reflect_direction(v, s->normal, s->cosine);
    const real away = dot3(f->normal, r), open_r = facet_openness(f, away);
    const real beyond = fused(out->eta, f->cosine, -out->bend * dot3(f->normal, s->normal));
    real open_t = facet_openness(f, beyond);
    if (GLINT_THIN_WALL) {
        const mask thin = f->there & HAS_FLAG(*s, GLINT_MATERIAL_THIN);
        const real3 mirrored = scale_add(f->normal, R(-2.0) * away, r);
        const real3 t = renormalized(fold_to_side(mirrored, s->geometric_normal, R(-1.0)));
        out->transmitted = select3(thin, t, out->transmitted);
        open_t = SELECT(thin, open_r, open_t);
    }
    const real one = real_of(1);
    out->reflected_weight = scale(out->reflected_weight, SELECT(f->there, open_r, one));
    out->transmitted_weight = scale(out->transmitted_weight, SELECT(f->there, open_t, one));
}
#endif

// The light on matte paint, over π: the environment, darkened by occlusion, and the file's lights.
static inline real3 light_on_paint(const scene_buffers *scene, const surface *s, real3 irradiance)
{
#if GLINT_TEXTURES
    irradiance = HAS(TEXTURES) ? scale(irradiance, s->occlusion) : irradiance;
#endif
#if GLINT_LIGHTS
    irradiance = HAS(LIGHTS) ? add(irradiance, s->direct) : irradiance;
#endif
    return irradiance;
}

// Scatters light at the surface by all models. `media` is the path's stack; if the path began
// inside the solid that it meets, the stack is corrected.
static inline scattering scatter(const scene_buffers *scene, const surface *s, real3 v,
                                 lanes_int *media, real3 irradiance, mask *media_lost)
{
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    scattering result;
    result.emitted = zero;
    result.reflected_weight = result.transmitted_weight = zero;
#if GLINT_ROUGH
    result.rough = are_rough(scene, s);
    result.lobe_base = result.lobe_edge = result.matte_base = result.matte_edge = zero;
    result.lobe_weight = real_of(0);
#endif
    *media_lost = mask_none();

    // The shares of the three models, metallic first: metal, then glass. The rest is paint.
    const real dielectric = R(1.0) - s->metallic;
    const real glass = dielectric * s->transmission;

    // Metal.
    real3 r = reflect_direction(v, s->normal, s->cosine);
    result.reflected = renormalized(fold_to_side(r, s->geometric_normal, R(1.0)));
    if (GLINT_TINT) {
        result.reflected_weight = scale(reflect_from_metal(scene, s), s->metallic);
    } else if (GLINT_MIRROR) {
        result.reflected_weight = real3_of(s->metallic, s->metallic, s->metallic);
    }
    // Glass.
    if (HAS(GLASS)) {
        scatter_glass(scene, s, v, glass, media, &result, media_lost);
    } else {
        result.transmitted = negate(v);
        result.media_transmitted = *media;
        result.total_reflection = mask_none();
        result.eta = real_of(1);
        result.bend = real_of(0);
    }
    result.media_reflected = *media;
    // Paint and rough lobes.
    irradiance = light_on_paint(scene, s, irradiance);
    real kept = real_of(1);
#if GLINT_ROUGH
    if (any_lane(result.rough)) {
        kept = SELECT(result.rough, scatter_lobe(scene, s, dielectric - glass, &result), kept);
    }
#endif
    if (HAS(PAINT)) {
        scatter_paint(scene, s, irradiance, dielectric - glass, kept, &result);
    }
#if GLINT_ROUGH && GLINT_LIGHTS
    if (HAS(LIGHTS)) {
        const real3 shine = add(multiply(add(result.lobe_base, result.matte_base), s->shine_base),
                                multiply(add(result.lobe_edge, result.matte_edge), s->shine_edge));
        result.emitted = select3(result.rough, add(result.emitted, shine), result.emitted);
    }
#endif
    // Facets of rough glass, sheen, then the models that replace or add to the others.
#if GLINT_FACETS
    scatter_from_facets(s, v, &result);
#endif
#if GLINT_SHEEN
    result.sheen = zero;
    if (HAS(SHEEN)) {
        scatter_from_sheen(scene, s, &result);
    }
#endif
    if (HAS(BLEND)) {
        scatter_blend(s, irradiance, &result);
    }
    if (GLINT_EMISSION) {
        result.emitted = add(result.emitted, s->emission);
    }
    if (GLINT_UNLIT) {
        const mask unlit = HAS_FLAG(*s, GLINT_MATERIAL_UNLIT);
        result.emitted = select3(unlit, s->base_color, result.emitted);
        result.reflected_weight = select3(unlit, zero, result.reflected_weight);
        result.transmitted_weight = select3(unlit, zero, result.transmitted_weight);
    }
    // Layers above all the others.
#if GLINT_CLEARCOAT
    result.coat_apart = mask_none();
    if (HAS(CLEARCOAT)) {
        scatter_from_coat(scene, s, v, *media, &result);
    }
#endif
#if GLINT_ALPHA
    if (HAS(ALPHA)) {
        scatter_covered(scene, s, v, *media, &result);
    }
#endif
    return result;
}
