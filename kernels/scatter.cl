// How a surface divides light (rules 3 to 6): what it adds itself, and the weights and directions
// of the reflected and of the transmitted branch.

typedef struct scattering {
    real3 emitted; // radiance that the path gathers here: emission, paint, unlit colour
    real3 reflected, reflected_weight; // unit direction; factors of R, G, B
#if GLINT_GLASS
    real3 transmitted, transmitted_weight;
    lanes_int media_transmitted; // the stack of media beyond the surface
    mask total_reflection;
#if GLINT_MIP_LEVELS
    real eta, bend; // of the transmitted ray, see leave_surface
#endif
#endif
    lanes_int media_reflected;
} scattering;

#if GLINT_GLASS
// Rule 4, glass: reflectance and transmitted direction. A thin wall is one interface from empty
// space, whatever the side, and lets light pass straight on.
static inline real glass_reflectance(const surface *s, real3 v, real eta, real3 *transmitted,
                                     real *bend, mask *total_reflection)
{
    real squared = transmitted_cosine_squared(s->cosine, eta);
    *total_reflection = !(squared >= R(0.0));
    real cosine_t = sqrt(SELECT(*total_reflection, real_of(0), squared));
#if GLINT_FRESNEL
    real reflectance = dielectric_reflectance(s->cosine, cosine_t, eta);
#else
    real reflectance = real_of(0);
#endif
    reflectance = SELECT(*total_reflection, real_of(1), reflectance);
    *bend = fused(eta, s->cosine, -cosine_t);
    *transmitted = fold_to_side(refract_direction(v, s->normal, s->cosine, eta, cosine_t),
                                s->geometric_normal, R(-1.0));
    *transmitted = renormalized(*transmitted);
    return reflectance;
}
#endif

#if GLINT_SOLID
// Rule 5: the media on both sides of a solid's surface. A back face met with an empty stack means
// that the path began inside that solid. Sets the stacks of both branches and returns η = n_i/n_t.
static inline real cross_solid(const scene_buffers *scene, const surface *s, mask solid,
                               lanes_int *media, lanes_int *beyond, mask *lost)
{
    mask inside = solid & !s->outside;
    *media = SELECT(inside & (*media == (lane_int)0), s->medium, *media);
    lanes_int entered = enter_medium(*media, s->medium, lost);
    lanes_int left = leave_medium(*media, s->medium);
    *beyond = SELECT(solid, SELECT(s->outside, entered, left), *media);
    *lost = *lost & solid & s->outside;
    real n_i = medium_ior(scene->media, medium_on_top(*media));
    real n_t = medium_ior(scene->media, medium_on_top(*beyond));
    return n_i / n_t;
}
#endif

#if GLINT_PAINT
// Rule 6: what paint sends back of the environment's irradiance (the map holds E(n)/π).
static inline real3 paint_radiance(const scene_buffers *scene, const surface *s, real3 irradiance,
                                   real share, real reflectance)
{
    real3 lit = multiply(s->base_color, irradiance);
#if GLINT_GLOSS
    real kept = SELECT(HAS_FLAG(*s, GLINT_MATERIAL_GLOSS), R(1.0) - reflectance, real_of(1));
#else
    real kept = real_of(1);
#endif
    return scale(lit, share * kept);
}
#endif

// `media` is the path's stack; a path that began inside the solid it meets has it put right.
static inline scattering scatter(const scene_buffers *scene, const surface *s, real3 v,
                                 lanes_int *media, real3 irradiance, mask *media_lost)
{
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    scattering result;
    result.emitted = zero;
    result.reflected_weight = zero;
    *media_lost = mask_none();

    // Shares of the three models, metallic first: metal, then glass, the rest is paint.
#if GLINT_GLASS || GLINT_PAINT
    real dielectric = R(1.0) - s->metallic;
    real glass = dielectric * s->transmission;
#endif

    real3 r = reflect_direction(v, s->normal, s->cosine);
    result.reflected = renormalized(fold_to_side(r, s->geometric_normal, R(1.0)));
#if GLINT_TINT
    result.reflected_weight = scale(metal_reflectance(s->base_color, s->cosine), s->metallic);
#elif GLINT_MIRROR
    result.reflected_weight = real3_of(s->metallic, s->metallic, s->metallic);
#endif
#if GLINT_GLASS
    mask is_glass = glass > R(0.0);
    real eta = R(1.0) / s->ior;
    result.media_transmitted = *media;
#if GLINT_SOLID
    mask solid = HAS_FLAG(*s, GLINT_MATERIAL_SOLID);
    real solid_eta = cross_solid(scene, s, solid, media, &result.media_transmitted, media_lost);
    eta = SELECT(solid, solid_eta, eta);
#endif
    real bend;
    real reflectance =
        glass_reflectance(s, v, eta, &result.transmitted, &bend, &result.total_reflection);
#if GLINT_THIN_WALL
    mask thin = HAS_FLAG(*s, GLINT_MATERIAL_THIN);
    result.transmitted = select3(thin, negate(v), result.transmitted);
    bend = SELECT(thin, real_of(0), bend);
    eta = SELECT(thin, real_of(1), eta);
#endif
#if GLINT_MIP_LEVELS
    result.eta = eta;
    result.bend = bend;
#endif
    real reflected_glass = glass * reflectance;
    result.reflected_weight =
        add(result.reflected_weight, real3_of(reflected_glass, reflected_glass, reflected_glass));
    result.transmitted_weight = scale(s->base_color, glass - reflected_glass);
    result.total_reflection = result.total_reflection & is_glass;
#endif
    result.media_reflected = *media;
#if GLINT_PAINT
    real paint = dielectric - glass;
    real paint_reflectance = real_of(0);
#if GLINT_GLOSS
    paint_reflectance = surface_reflectance(s->cosine, s->ior);
    real gloss = SELECT(HAS_FLAG(*s, GLINT_MATERIAL_GLOSS), paint * paint_reflectance, real_of(0));
    result.reflected_weight = add(result.reflected_weight, real3_of(gloss, gloss, gloss));
#endif
    result.emitted = paint_radiance(scene, s, irradiance, paint, paint_reflectance);
#endif
#if GLINT_BLEND
    mask blended = HAS_FLAG(*s, GLINT_MATERIAL_BLEND);
    real3 matte = scale(multiply(s->base_color, irradiance), R(1.0) - s->blend);
    result.emitted = select3(blended, matte, result.emitted);
    real3 mirrored = real3_of(s->blend, s->blend, s->blend);
    result.reflected_weight = select3(blended, mirrored, result.reflected_weight);
#if GLINT_GLASS
    result.transmitted_weight = select3(blended, zero, result.transmitted_weight);
#endif
#endif
#if GLINT_EMISSION
    result.emitted = add(result.emitted, s->emission);
#endif
#if GLINT_UNLIT
    mask unlit = HAS_FLAG(*s, GLINT_MATERIAL_UNLIT);
    result.emitted = select3(unlit, s->base_color, result.emitted);
    result.reflected_weight = select3(unlit, zero, result.reflected_weight);
#if GLINT_GLASS
    result.transmitted_weight = select3(unlit, zero, result.transmitted_weight);
#endif
#endif
    return result;
}
