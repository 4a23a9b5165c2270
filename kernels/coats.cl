// Lays a clear coat over the other layers of a surface (rule 13 of docs/light_transport.md).
#if GLINT_CLEARCOAT
#define CLEARCOAT_IOR R(1.5)
#define CLEARCOAT_F0 R(0.04)

#if GLINT_ROUGH
static inline mask is_coat_rough(const scene_buffers *scene, const surface *s)
{
    return !HAS(ROUGH) ? mask_none() : (s->clearcoat > R(0.0)) &
           (s->clearcoat_roughness >= (scalar)GLINT_ROUGHNESS_LEAST);
}
#endif

// The reflectance of a full clear coat: the whole, and the part that comes by a path.
typedef struct coat_reflectance {
    real whole, by_path;
} coat_reflectance;

static inline coat_reflectance reflect_from_coat(const scene_buffers *scene, const surface *s,
                                                 scattering *out)
{
    coat_reflectance f;
    f.whole = f.by_path = surface_reflectance(s->clearcoat_cosine, real_of(CLEARCOAT_IOR));
#if GLINT_ROUGH
    const mask rough = out->coat_rough = is_coat_rough(scene, s);
    const lobe_parts albedo = out->coat_albedo =
        find_albedo(scene, s->clearcoat_cosine, s->clearcoat_roughness, rough);
    out->coat_gain = fused(light_lost(scene, &albedo), real_of(CLEARCOAT_F0), real_of(1));
    const real lobe = out->coat_gain * fused(albedo.base, real_of(CLEARCOAT_F0), albedo.edge);
    f.whole = SELECT(rough, lobe, f.whole);
    f.by_path = SELECT(rough, lobe * share_of_path(s->clearcoat_roughness), f.by_path);
#endif
    return f;
}

// Finds coats whose reflection shares the direction of the reflection below.
static inline mask are_coats_joined(const surface *s, const scattering *out)
{
    return (s->clearcoat > R(0.0)) & !out->coat_apart;
}

#if COATS_APART
// Finds coats that reflect in another direction than the layers below, if no other branch goes on.
static inline mask are_coats_apart(const surface *s, const scattering *out, mask coated)
{
    const real3 n = s->normal, c = s->clearcoat_normal;
    mask apart = (n.x != c.x) | (n.y != c.y) | (n.z != c.z);
#if GLINT_ROUGH
    apart = apart | out->rough | out->coat_rough;
#endif
#if GLINT_ALPHA
    coated = coated & !(s->coverage < R(1.0));
#endif
    return coated & apart & (largest3(out->reflected_weight) > R(0.0)) &
           !(largest3(out->transmitted_weight) > R(0.0));
}
#endif

// Rule 13: a clear coat above the rest of the surface. If the coat has no branch of its own, the
// reflection of the layers below takes the coat's direction.
static inline void scatter_from_coat(const scene_buffers *scene, const surface *s, real3 v,
                                     lanes_int media, scattering *out)
{
    const coat_reflectance f = reflect_from_coat(scene, s, out);
    out->coat_weight = s->clearcoat * f.by_path;
    leave_share(fused(-s->clearcoat, f.whole, real_of(1)), out);
#if GLINT_ROUGH && GLINT_LIGHTS
    if (HAS(LIGHTS)) {
        const real gain = s->clearcoat * out->coat_gain;
        out->emitted = select3(out->coat_rough, scale_add(s->clearcoat_shine, gain, out->emitted),
                               out->emitted);
    }
#endif
    const real3 r = reflect_direction(v, s->clearcoat_normal, s->clearcoat_cosine);
    const real3 direction = renormalized(fold_to_side(r, s->geometric_normal, R(1.0)));
    const real3 weight = real3_of(out->coat_weight, out->coat_weight, out->coat_weight);
#if COATS_APART
    const mask apart = out->coat_apart = are_coats_apart(s, out, s->clearcoat > R(0.0));
    out->transmitted = select3(apart, direction, out->transmitted);
    out->transmitted_weight = select3(apart, weight, out->transmitted_weight);
    out->media_transmitted = SELECT(apart, media, out->media_transmitted);
    out->eta = SELECT(apart, real_of(1), out->eta);
    out->bend = SELECT(apart, real_of(2), out->bend);
#endif
    const mask joined = are_coats_joined(s, out);
    out->reflected = select3(joined, direction, out->reflected);
    out->reflected_weight =
        select3(joined, add(out->reflected_weight, weight), out->reflected_weight);
}
#endif
