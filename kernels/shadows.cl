// Traces shadow rays: finds the share of a light's light that reaches a surface. The rays run from
// the surface to the light. The rays of a packet go as one frustum while they stay close to each
// other. Otherwise each ray goes alone, with an early exit at any opaque surface. Other surfaces
// let light pass straight, without refraction. Glass filters it by its Fresnel term and its colour,
// a solid by absorption, and alpha lets the uncovered part pass. Rays pass these surfaces nearest
// first, so the product has the same bits in every tree.
#if GLINT_LIGHTS

// If more surfaces than these are on the way, no light is left.
#define SHADOW_SURFACES 64

// True if light may pass the triangles of a cluster.
static inline bool lets_light_pass(const scene_buffers *scene, global const float *cluster)
{
#if TRANSMITS
    const int material =
        GLINT_MANY_MATERIALS ? material_of_cluster(cluster) : 0;
    return (scene->materials[material].flags & (GLINT_MATERIAL_SOLID | GLINT_MATERIAL_THIN |
                                                GLINT_MATERIAL_MASK | GLINT_MATERIAL_COVER)) != 0;
#else
    return false;
#endif
}

// If the ray meets triangle i of a leaf before *hit, in the ray's lane, the triangle becomes the
// hit. A light in the plane of a triangle is on this side of it. So hits near the light are tested
// again.
static inline bool meet_before_light(const stream_ray *r, const leaf *leaf,
                                     const cluster_test *test, int i,
                                     global const glint_light_record *light, scalar light_at,
                                     closest *hit)
{
    closest trial = *hit;
    if (!take_if_nearer(&r->ray, leaf, test, i, &trial, r->lane)) {
        return false;
    }
    if (LANE(trial.t, r->lane) > (R(1.0) - NEXT_TO_NOTHING) * light_at) {
        float own[9];
        scalar at[9];
        load_triangle(leaf->cluster, i, own);
        for (int k = 0; k < 9; k++) {
            at[k] = FROM_ANCHOR(leaf->cluster, k % 3, (scalar)light->position[k % 3]);
        }
        if (lie_in_plane(leaf->scene, own, at)) {
            return false;
        }
    }
    *hit = trial;
    return true;
}

// True if an opaque surface is on the way, whose length is `light_at`. Otherwise the nearest
// surface that lets light pass becomes *hit, in the ray's lane.
static inline bool is_blocked(stream_ray *r, const scene_buffers *scene,
                              global const glint_light_record *light, scalar light_at, closest *hit)
{
    int stack[GLINT_TRAVERSAL_STACK];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const int child = stack[--size];
        if (child >= 0) {
            node_pointer node = node_at(scene, child);
            for (uint met = boxes_at_ray(r, node); met != 0; met &= met - 1) {
                stack[size++] = child_of(node, lowest_bit(met));
            }
            continue;
        }
        const leaf leaf = leaf_at(scene, ~child);
        cluster_test test;
        bool found = false;
        test_cluster(&r->ray, &leaf, &test);
        for (uint left = test.inside; left != 0; left &= left - 1) {
            found |= meet_before_light(r, &leaf, &test, lowest_bit(left), light, light_at, hit);
        }
        if (found && !lets_light_pass(scene, leaf.cluster)) {
            return true;
        }
        r->farthest = SMALLER(r->farthest, LANE(hit->t, r->lane));
    }
    return false;
}

#if GLINT_WIDTH > 1

// Finds the closest hits of rays that stay close to each other, as one frustum. Returns the rays
// that must be traced alone: incoherent rays, and rays whose hit is near the light.
static inline mask trace_alike(const scene_buffers *scene, const path *rays, const packet *p,
                               mask wanted, closest *hit)
{
    const real light_at = hit->t;
    mask left = wanted, alone = mask_none();
    while (any_lane(left)) {
        int along;
        scalar sign;
        choose_axis(p, &left, &along, &sign);
        const mask together = rays_along(&rays->direction, along, sign, left);
        bundle b = make_bundle(p, along, sign, together);
        left = left & !together;
        if (b.bounds.wide) {
            alone = alone | together;
            continue;
        }
        update_farthest(&b, hit);
        group_frusta several; // has no groups
        party one;
        one.bounds = b.bounds;
        one.farthest = b.farthest;
        one.groups = 1;
        trace_party(&one, &several, &b, scene, rays, hit);
    }
    const mask near = (hit->place >= (lane_int)0) & (hit->t > (R(1.0) - NEXT_TO_NOTHING) * light_at);
    return wanted & (alone | near);
}

#endif

// Returns the blocked rays. `distance` is the distance of the light. For the other rays, *hit is
// the nearest surface that lets light pass.
static inline mask trace_to_light(const scene_buffers *scene, const path *rays,
                                  global const glint_light_record *light, real distance,
                                  mask wanted, closest *hit)
{
    const packet p = packet_of_paths(rays);
    lanes_int blocked = int_of(0);
    *hit = no_hit();
    const real light_at = SMALLER(distance, hit->t);
    hit->t = light_at;
    // Trace coherent rays together.
    mask alone = wanted & is_sound(rays->origin, rays->direction);
#if GLINT_WIDTH > 1
    alone = trace_alike(scene, rays, &p, alone, hit);
    hit->t = SELECT(alone, light_at, hit->t);
    hit->place = SELECT(alone, int_of(-1), hit->place);
    for (uint met = mask_bits(hit->place >= (lane_int)0); met != 0; met &= met - 1) {
        const int lane = lowest_bit(met);
        const size_t cluster = (size_t)LANE_INT(hit->place, lane) / GLINT_CLUSTER_LANES;
        LANE_INT(blocked, lane) =
            lets_light_pass(scene, scene->clusters + cluster * GLINT_CLUSTER_VALUES) ? 0 : 1;
    }
#endif
    // Trace the other rays alone.
    for (uint left = mask_bits(alone); left != 0; left &= left - 1) {
        stream_ray r;
        const int lane = lowest_bit(left);
        take_stream_ray(&p, 0, lane, rays->from, &r);
        r.farthest = SMALLER(r.farthest, LANE(light_at, lane));
        LANE_INT(blocked, lane) = is_blocked(&r, scene, light, LANE(light_at, lane), hit) ? 1 : 0;
    }
    return blocked != (lane_int)0;
}

#if TRANSMITS

// The share of straight light that a surface lets pass.
static inline real3 light_passing(const scene_buffers *scene, const surface *s)
{
    real3 passing = real3_of(real_of(0), real_of(0), real_of(0));
#if GLINT_GLASS
    const mask glass = HAS_FLAG(*s, GLINT_MATERIAL_SOLID) | HAS_FLAG(*s, GLINT_MATERIAL_THIN);
    const real share = (R(1.0) - s->metallic) * s->transmission;
    real reflectance = real_of(0);
    if (HAS(FRESNEL)) {
        reflectance = largest3(specular_from_space(scene, s, false));
    }
    real left = share - share * reflectance;
#if GLINT_CLEARCOAT
    if (HAS(CLEARCOAT)) {
        left *= R(1.0) - s->clearcoat * surface_reflectance(s->clearcoat_cosine,
                                                            real_of(CLEARCOAT_IOR));
    }
#endif
    passing = scale(s->base_color, SELECT(glass, left, real_of(0)));
#endif
#if GLINT_ALPHA
    if (HAS(ALPHA)) {
        const mask partly = s->coverage < R(1.0);
        const real gone = SELECT(partly, R(1.0) - s->coverage, real_of(0));
        passing = add(scale(passing, SELECT(partly, s->coverage, real_of(1))),
                      real3_of(gone, gone, gone));
    }
#endif
    return passing;
}

// Moves the rays in `met` past their hits. `left` is the light that they have left.
static inline void pass_surfaces(const scene_buffers *scene, path *rays, closest *hit, mask met,
                                 real3 *left)
{
    triangle triangles = load_triangles(scene, SELECT(met, hit->place, int_of(0)), met);
    const surface s = find_surface_in_place(scene, rays, met, hit, &triangles);
    lanes_int beyond = rays->media;
#if GLINT_SOLID
    mask lost;
    real outer;
    (void)cross_solid(scene, &s, HAS_FLAG(s, GLINT_MATERIAL_SOLID), &rays->media, &beyond, &outer,
                      &lost);
#endif
    real3 passing = light_passing(scene, &s);
#if GLINT_ABSORPTION
    if (HAS(ABSORPTION)) {
        passing = multiply(passing, medium_transmittance(scene, medium_on_top(scene, rays->media),
                                                         SELECT(met, hit->t, real_of(0))));
    }
#endif
    *left = select3(met, multiply(*left, passing), *left);
    rays->media = SELECT(met, beyond, rays->media);
    start_off_surface(scene, rays, &s, -s.offset);
    rays->from = hit->place;
}

#endif

// The share of a light's light that is left at the rays' origins.
static inline real3 light_left(const scene_buffers *scene, path *rays,
                               global const glint_light_record *light, real distance, mask wanted)
{
    const real one = real_of(1);
    const real3 nothing = real3_of(real_of(0), real_of(0), real_of(0));
    real3 left = real3_of(one, one, one);
    closest hit;
    const mask dark = trace_to_light(scene, rays, light, distance, wanted, &hit);
    left = select3(dark, nothing, left);
#if TRANSMITS
    wanted = wanted & !dark & (hit.place >= (lane_int)0);
    for (int passed = 1; any_lane(wanted); passed++) {
        pass_surfaces(scene, rays, &hit, wanted, &left);
        distance -= hit.t;
        wanted = wanted & (largest3(left) > R(0.0));
        const mask blocked = trace_to_light(scene, rays, light, distance, wanted, &hit) |
                             (passed == SHADOW_SURFACES ? mask_all() : mask_none());
        left = select3(wanted & blocked, nothing, left);
        wanted = wanted & !blocked & (hit.place >= (lane_int)0);
    }
#endif
    return left;
}

#endif
