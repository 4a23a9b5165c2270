// Adds punctual lights (KHR_lights_punctual, glint_light_record of layout.h). They shine on matte
// paint and in the lobes of rough surfaces. Mirrors and glass do not show them, because a point has
// no size.
#if GLINT_LIGHTS

// The light that a lamp sends to surfaces if nothing is on the way.
typedef struct arrival {
    real3 direction;  // unit, to the light
    real distance;    // to the light; HUGE for a directional light
    // Irradiance over π of a surface that faces the light; 0 if the light is not above the surface.
    real3 radiance;
    real3 irradiance; // irradiance over π of this surface
} arrival;

static inline real3 join_vector_of(global const glint_split_vector *v)
{
    const glint_split_vector own = *v;
    return join_vector(&own);
}

static inline real between_0_and_1(real x)
{
    x = LARGER(x, real_of(0));
    return SMALLER(x, real_of(1));
}

// The falloff of a point light at the squared distance: max(1 − (d/range)⁴, 0)/d².
static inline real falloff(global const glint_light_record *light, real squared)
{
    const real share = squared * JOIN(light->inverse_range[0], light->inverse_range[1]);
    const real open = R(1.0) - share * share;
    return LARGER(open, real_of(0)) / squared;
}

// The falloff of a spot's cone: ((cos θ − cos outer)/(cos inner − cos outer))², in [0, 1].
static inline real cone_left(global const glint_light_record *light, real3 to_light)
{
    const real cosine = -dot3(to_light, join_vector_of(&light->axis));
    const real share = (cosine - JOIN(light->outer_cosine[0], light->outer_cosine[1])) *
                       JOIN(light->cone_scale[0], light->cone_scale[1]);
    const real left = between_0_and_1(share);
    return left * left;
}

// Finds the light that arrives from one light. If the light lies in the surface's plane, within
// rounding, it is not above the surface.
static inline arrival arrive(global const glint_light_record *light, const surface *s)
{
    arrival a;
    mask above;
    real strength = real_of(1);
    if (light->kind == GLINT_LIGHT_DIRECTIONAL) {
        a.direction = negate(join_vector_of(&light->axis));
        a.distance = real_of(HUGE);
        above = dot3(a.direction, s->geometric_normal) > R(0.0);
    } else {
        const real3 to = subtract(real3_of(real_of(light->position[0]), real_of(light->position[1]),
                                           real_of(light->position[2])),
                                  s->position);
        const real squared = dot3(to, to);
        a.direction = normalized(to, &above);
        a.distance = sqrt(squared);
        above = above & (dot3(to, s->geometric_normal) > s->offset);
        strength = falloff(light, squared);
        if (light->kind == GLINT_LIGHT_SPOT) {
            strength *= cone_left(light, a.direction);
        }
    }
    const real3 color = join_vector_of(&light->color);
    const real lit = strength * dot3(a.direction, s->lit_normal);
    // NaN gives nothing.
    a.irradiance = scale(color, SELECT(above & (lit > R(0.0)), lit, real_of(0)));
    a.radiance = scale(color, SELECT(above & (strength > R(0.0)), strength, real_of(0)));
    return a;
}

// Surfaces that reflect part of the light as matte paint.
static inline mask is_matte(const surface *s)
{
    mask matte = (R(1.0) - s->metallic) * (R(1.0) - s->transmission) > R(0.0);
    if (GLINT_BLEND) {
        matte = matte | (HAS_FLAG(*s, GLINT_MATERIAL_BLEND) & (s->blend < R(1.0)));
    }
#if GLINT_ALPHA
    matte = matte & (s->coverage > R(0.0));
#endif
    return matte & (largest3(s->base_color) > R(0.0));
}

#if GLINT_ROUGH
// Surfaces whose lobes show lights.
static inline mask may_shine(const scene_buffers *scene, const surface *s)
{
    mask rough = are_rough(scene, s);
#if GLINT_CLEARCOAT
    rough = HAS(CLEARCOAT) ? rough | is_coat_rough(scene, s) : rough;
#endif
#if GLINT_SHEEN
    rough = HAS(SHEEN) ? rough | (largest3(s->sheen_color) > R(0.0)) : rough;
#endif
#if GLINT_ALPHA
    rough = rough & (s->coverage > R(0.0));
#endif
    return rough;
}

// True if a light is in front of a layer that shows it.
static inline mask is_before(const scene_buffers *scene, const surface *s, real3 direction)
{
    mask before = dot3(s->normal, direction) > R(0.0);
#if GLINT_CLEARCOAT
    if (HAS(CLEARCOAT)) {
        const mask by_coat = dot3(s->clearcoat_normal, direction) > R(0.0);
        before = before | (is_coat_rough(scene, s) & by_coat);
    }
#endif
    return before;
}

// Adds the light that the rays in `lit` see in their lobes. `left` is the share of the light that
// arrives.
static inline void shine(const scene_buffers *scene, const path *ray, const arrival *a, real3 left,
                         mask lit, surface *s)
{
    const real3 light = scale(multiply(left, a->radiance), real_of(R(3.1415926535897932)));
    const lobe_shape shape = shape_of_surface(s);
    const lobe_parts parts = weigh_light(scene, &shape, negate(ray->direction), a->direction, lit);
    s->shine_base = select3(lit, scale_add(light, parts.base, s->shine_base), s->shine_base);
    s->shine_edge = select3(lit, scale_add(light, parts.edge, s->shine_edge), s->shine_edge);
#if GLINT_CLEARCOAT
    if (HAS(CLEARCOAT)) {
        const lobe_shape of_coat = shape_of_coat(s);
        const lobe_parts coat =
            weigh_light(scene, &of_coat, negate(ray->direction), a->direction, lit);
        const real shown = fused(coat.base, real_of(CLEARCOAT_F0), coat.edge);
        s->clearcoat_shine =
            select3(lit, scale_add(light, shown, s->clearcoat_shine), s->clearcoat_shine);
    }
#endif
#if GLINT_SHEEN
    if (HAS(SHEEN)) {
        const lobe_shape of_sheen = shape_of_sheen(s);
        const real fibres =
            weigh_light(scene, &of_sheen, negate(ray->direction), a->direction, lit).base;
        s->sheen_shine = select3(lit, scale_add(light, fibres, s->sheen_shine), s->sheen_shine);
    }
#endif
}
#endif

// Adds the light of all lights to the surfaces at `places` that the rays in `met` have met. Adds
// the number of shadow rays to a counter.
static inline void light_surface(const scene_buffers *scene, const path *ray, surface *s,
                                 lanes_int places, mask met, ulong *shadow_rays)
{
    // Find the surfaces that show lights.
    const real3 nothing = real3_of(real_of(0), real_of(0), real_of(0));
    const mask seen = met & (largest3(ray->weight) > R(0.0));
    const mask matte = seen & is_matte(s);
    mask rough = mask_none();
#if GLINT_ROUGH
    rough = seen & may_shine(scene, s);
#endif
    if (!any_lane(matte | rough)) {
        return;
    }
    for (global const glint_light_record *light = scene->lights; light->kind != GLINT_LIGHT_NONE;
         light++) {
        const arrival a = arrive(light, s);
        const mask on_paint = matte & (largest3(a.irradiance) > R(0.0));
        mask shines = mask_none();
#if GLINT_ROUGH
        shines = rough & (largest3(a.radiance) > R(0.0)) & is_before(scene, s, a.direction);
#endif
        const mask lit = on_paint | shines;
        if (!any_lane(lit)) {
            continue;
        }
        // Make the shadow rays.
        path to_light = *ray;
        start_off_surface(scene, &to_light, s, s->offset);
        to_light.direction = a.direction;
        to_light.from = places;
#if GLINT_SOLID
        to_light.media = media_met_in(scene, s, HAS_FLAG(*s, GLINT_MATERIAL_SOLID), ray->media);
#endif
#if CARRIES_CONES
        to_light.cone.width = to_light.cone.spread = real_of(0);
#endif
#if GLINT_FACETS
        to_light.lobe.width = to_light.lobe.spread = real_of(0);
#endif
        // Add the light that arrives.
        const real3 left = light_left(scene, &to_light, light, a.distance, lit);
        s->direct = add(s->direct, select3(on_paint, multiply(left, a.irradiance), nothing));
#if GLINT_ROUGH
        shine(scene, ray, &a, left, shines, s);
#endif
        *shadow_rays += (ulong)count_lanes(lit);
    }
}

#endif
