// Runs single parts of the renderer on rays and numbers from the host, for host/render/probe.h.
// These kernels are compiled behind render.cl, with the features of the current scene.
//
// Element i of an array belongs to lane i % GLINT_WIDTH of packet i / GLINT_WIDTH. A work-item
// takes PATH_GROUPS packets. The host fills arrays up to a whole number of work-items.

#define PROBE_ARGUMENTS                                                                            \
    GLINT_SCENE_ARGUMENTS(PARAMETER)                                                               \
    GLINT_PROBE_ARGUMENTS(PARAMETER) const glint_frame_record frame

// Loads value `which` of each element of a packet; an element has `values` values.
static inline real probe_load(global const scalar *in, size_t packet, int values, int which)
{
    real value;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE(value, lane) = in[values * (packet * GLINT_WIDTH + lane) + which];
    }
    return value;
}

static inline real3 probe_load3(global const scalar *in, size_t packet, int values, int which)
{
    return real3_of(probe_load(in, packet, values, which),
                    probe_load(in, packet, values, which + 1),
                    probe_load(in, packet, values, which + 2));
}

static inline void probe_store(global scalar *out, size_t packet, int values, int which, real value)
{
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        out[values * (packet * GLINT_WIDTH + lane) + which] = LANE(value, lane);
    }
}

static inline void probe_store3(global scalar *out, size_t packet, int values, int which, real3 v)
{
    probe_store(out, packet, values, which, v.x);
    probe_store(out, packet, values, which + 1, v.y);
    probe_store(out, packet, values, which + 2, v.z);
}

static inline real probe_flag(mask yes) { return SELECT(yes, real_of(1), real_of(0)); }

// ---- Rays --------------------------------------------------------------------------------------

// Loads rays of GLINT_PROBE_RAY numbers: origin, unit direction, the place of the triangle that the
// ray starts on (−1: none), the stack of media that it is inside, and the low parts of the origin.
static inline void probe_rays(global const scalar *in, size_t first, path *rays, mask *active)
{
    for (int g = 0; g < PATH_GROUPS; g++) {
        path *ray = &rays[SLOT(g)];
        const size_t packet = first + g;
        *ray = path_at_start();
        ray->origin = probe_load3(in, packet, GLINT_PROBE_RAY, 0);
#if LOCAL_RAYS
        ray->origin_low = probe_load3(in, packet, GLINT_PROBE_RAY, 8);
#endif
        ray->direction = probe_load3(in, packet, GLINT_PROBE_RAY, 3);
        ray->from = to_int_truncated(probe_load(in, packet, GLINT_PROBE_RAY, 6));
        ray->media = to_int_truncated(probe_load(in, packet, GLINT_PROBE_RAY, 7));
        active[SLOT(g)] = mask_all();
    }
}

static inline real probe_numbers(global const int *numbers, lanes_int places)
{
    real found = real_of(-1);
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        const int place = (int)LANE_INT(places, lane);
        if (place >= 0) {
            LANE(found, lane) = (scalar)numbers[place];
        }
    }
    return found;
}

// Stores distance, barycentric weights of the second and third vertex, and the triangle's number
// (−1: none).
static inline void probe_store_hit(global scalar *out, size_t packet, int values,
                                   global const int *numbers, const closest *hit)
{
    probe_store3(out, packet, values, 0, real3_of(hit->t, hit->b1, hit->b2));
    probe_store(out, packet, values, 3, probe_numbers(numbers, hit->place));
}

// Finds the closest hits of a work-item's rays, as for secondary rays; sets the rays.
static NOT_INLINED void probe_closest(const scene_buffers *scene, global const scalar *in,
                                      size_t first, path *rays, closest *hits)
{
    mask active[PATH_GROUPS];
    probe_rays(in, first, rays, active);
    trace_groups(scene, rays, active, hits);
}

kernel void probe_trace(PROBE_ARGUMENTS)
{
    const scene_buffers scene = SCENE_OF_ARGUMENTS;
    const size_t first = get_global_id(0) * PATH_GROUPS;
    path rays[PATH_GROUPS];
    closest hits[PATH_GROUPS];
    probe_closest(&scene, in, first, rays, hits);
    for (int g = 0; g < PATH_GROUPS; g++) {
        probe_store_hit(out, first + g, GLINT_PROBE_HIT, numbers, &hits[SLOT(g)]);
    }
}

// Stores the reflected and the transmitted branch of rays at their next surface. glint_probe_bounce
// describes the GLINT_PROBE_BOUNCE numbers.
#if GLINT_GEOMETRY
static NOT_INLINED void probe_surface(const scene_buffers *scene, const path *ray, closest *hit,
                                 global scalar *out, size_t packet)
{
    const int values = GLINT_PROBE_BOUNCE;
    const mask met = hit->place >= (lane_int)0;
    triangle triangles = load_triangles(scene, SELECT(met, hit->place, int_of(0)), met);
    const surface s = find_surface_in_place(scene, ray, met, hit, &triangles);
    const real3 dark = real3_of(real_of(0), real_of(0), real_of(0));
    mask lost;
    lanes_int inside = ray->media;
    const scattering light = scatter(scene, &s, negate(ray->direction), &inside, dark, &lost);
    // Store the surface.
    probe_store3(out, packet, values, 4, s.geometric_normal);
    probe_store(out, packet, values, 7, probe_flag(s.outside));
    probe_store3(out, packet, values, 8, s.normal);
    probe_store(out, packet, values, 11, s.cosine);
    // Store the reflected branch.
    const path reflected = make_branch(scene, ray, &s, hit, light.reflected, mask_none());
    probe_store3(out, packet, values, 12, reflected.direction);
    probe_store(out, packet, values, 15, largest3(light.reflected_weight));
    probe_store3(out, packet, values, 16, reflected.origin);
#if LOCAL_RAYS
    probe_store3(out, packet, values, 30, reflected.origin_low);
#endif
    probe_store(out, packet, values, 19, to_real(hit->place));
    probe_store(out, packet, values, 20, to_real(light.media_reflected));
    if (GLINT_GLASS) {
        const path transmitted = make_branch(scene, ray, &s, hit, light.transmitted, mask_all());
        probe_store3(out, packet, values, 21, transmitted.direction);
        probe_store(out, packet, values, 24, largest3(light.transmitted_weight));
        probe_store3(out, packet, values, 25, transmitted.origin);
#if LOCAL_RAYS
        probe_store3(out, packet, values, 33, transmitted.origin_low);
#endif
        probe_store(out, packet, values, 28, to_real(light.media_transmitted));
        probe_store(out, packet, values, 29, probe_flag(light.total_reflection));
    }
}

kernel void probe_bounce(PROBE_ARGUMENTS)
{
    const scene_buffers scene = SCENE_OF_ARGUMENTS;
    const size_t first = get_global_id(0) * PATH_GROUPS;
    path rays[PATH_GROUPS];
    closest hits[PATH_GROUPS];
    probe_closest(&scene, in, first, rays, hits);
    for (int g = 0; g < PATH_GROUPS; g++) {
        for (int i = 4; i < GLINT_PROBE_BOUNCE; i++) {
            probe_store(out, first + g, GLINT_PROBE_BOUNCE, i, real_of(0));
        }
        probe_store_hit(out, first + g, GLINT_PROBE_BOUNCE, numbers, &hits[SLOT(g)]);
        if (any_lane(hits[SLOT(g)].place >= (lane_int)0)) {
            probe_surface(&scene, &rays[SLOT(g)], &hits[SLOT(g)], out, first + g);
        }
    }
}
#endif

// ---- Single functions: GLINT_PROBE_VALUES numbers in, as many out ------------------------------

static inline void probe_store4(global scalar *out, size_t packet, real3 v, real fourth)
{
    probe_store3(out, packet, GLINT_PROBE_VALUES, 0, v);
    probe_store(out, packet, GLINT_PROBE_VALUES, 3, fourth);
}

#define PROBE_IN(which) probe_load(in, packet, GLINT_PROBE_VALUES, which)
#define PROBE_PACKETS                                                                              \
    size_t packet = get_global_id(0) * PATH_GROUPS;                                                \
    packet < (get_global_id(0) + 1) * PATH_GROUPS;                                                 \
    packet++

// In: cos θi, η. Out: cos² θt; the reflectance (without total reflection); and the reflectance of a
// surface with the index of refraction 1/η.
kernel void probe_fresnel(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        const real cosine = PROBE_IN(0), eta = PROBE_IN(1);
        const real squared = transmitted_cosine_squared(cosine, eta);
        const real cosine_t = sqrt(LARGER(squared, real_of(0)));
        const real reflectance = dielectric_reflectance(cosine, cosine_t, eta);
        probe_store4(out, packet,
                     real3_of(squared, reflectance, surface_reflectance(cosine, R(1.0) / eta)),
                     real_of(0));
    }
}

// In: cos θi of a viewer in the xz plane, where the normal is +Z; and η. Out: x and z of the
// refracted direction, then of the reflected direction.
kernel void probe_directions(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        const real cosine = PROBE_IN(0), eta = PROBE_IN(1), zero = real_of(0);
        const real sine = sqrt((R(1.0) - cosine) * (R(1.0) + cosine));
        const real3 v = real3_of(sine, zero, cosine), n = real3_of(zero, zero, real_of(1));
        const real cosine_t = sqrt(LARGER(transmitted_cosine_squared(cosine, eta), zero));
        const real3 t = refract_direction(v, n, cosine, eta, cosine_t);
        const real3 r = reflect_direction(v, n, cosine);
        probe_store4(out, packet, real3_of(t.x, t.z, r.x), r.z);
    }
}

// In: cos θ, F0. Out: Schlick's reflectance.
kernel void probe_metal(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        const real f0 = PROBE_IN(1);
        const real3 reflected =
            metal_reflectance(real3_of(f0, f0, f0), PROBE_IN(0), GLINT_FRESNEL);
        probe_store4(out, packet, reflected, real_of(0));
    }
}

// In: a vector. Out: the unit vector along it (0 if there is none), and 1 if there is one.
kernel void probe_normalized(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        mask valid;
        const real3 v = real3_of(PROBE_IN(0), PROBE_IN(1), PROBE_IN(2));
        const real3 n = normalized(v, &valid);
        const real zero = real_of(0);
        probe_store4(out, packet, select3(valid, n, real3_of(zero, zero, zero)), probe_flag(valid));
    }
}

// In: a direction of any length. Out: the environment along it.
kernel void probe_environment(PROBE_ARGUMENTS)
{
    const scene_buffers scene = SCENE_OF_ARGUMENTS;
    for (PROBE_PACKETS) {
        const real3 d = real3_of(PROBE_IN(0), PROBE_IN(1), PROBE_IN(2));
        probe_store4(out, packet, sample_cube(&scene.environment, d, mask_all()), real_of(0));
    }
}

// In: a direction of any length. Out: the face of the cube in this direction, and the column and
// row on the face, in texels of the face with its border.
kernel void probe_face(PROBE_ARGUMENTS)
{
    const scene_buffers scene = SCENE_OF_ARGUMENTS;
    const cube_map *map = &scene.environment;
    for (PROBE_PACKETS) {
        const real3 d = real3_of(PROBE_IN(0), PROBE_IN(1), PROBE_IN(2));
        const cube_point point = find_on_cube(d, int_of(map->edge), int_of(0));
        const lane_int pitch = map->edge + 2 * GLINT_CUBE_BORDER;
        const real row = to_real(point.first / pitch % pitch) + point.down;
        const real column = to_real(point.first % pitch) + point.right;
        probe_store4(out, packet, real3_of(to_real(face_of(map, &point)), column, row), real_of(0));
    }
}

// The primary rays through the middles of pixels. The first two numbers of an element are the
// pixel's column and row.
static inline path probe_pixels(const glint_frame_record *frame, global const scalar *in,
                                size_t packet)
{
    primary first;
    first.x = place_x(frame, image_column(frame, to_int_truncated(PROBE_IN(0))), R(0.5));
    first.y = place_y(frame, image_row(frame, to_int_truncated(PROBE_IN(1))), R(0.5));
    return primary_rays(frame, &first);
}

// In: a column and a row. Out: the start of the primary ray.
kernel void probe_primary_origin(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        probe_store4(out, packet, probe_pixels(&frame, in, packet).origin, real_of(0));
    }
}

// In: a column and a row. Out: the unit direction of the primary ray.
kernel void probe_primary(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        probe_store4(out, packet, probe_pixels(&frame, in, packet).direction, real_of(0));
    }
}

// In: a work-item's index in the global range. Out: column and row of the tile that it renders, and
// the index of the tile's first value, in units of 2^24 and the rest.
kernel void probe_tile_place(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        for (int lane = 0; lane < GLINT_WIDTH; lane++) {
            global const scalar *id = in + GLINT_PROBE_VALUES * (packet * GLINT_WIDTH + lane);
            global scalar *place = out + GLINT_PROBE_VALUES * (packet * GLINT_WIDTH + lane);
            int column, row;
            find_tile(&frame, (int)id[0], (int)id[1], &column, &row);
            const size_t first = pixel_place(&frame, column, row);
            place[0] = (scalar)column;
            place[1] = (scalar)row;
            place[2] = (scalar)(first >> 24);
            place[3] = (scalar)(first & 0xffffff);
        }
    }
}

// In: the number of rounds, from the packet's first element. Out: the upper 24 bits of a random
// number generator after these rounds, seeded with 1.
kernel void probe_loop(PROBE_ARGUMENTS)
{
    for (PROBE_PACKETS) {
        const int rounds = (int)in[GLINT_PROBE_VALUES * packet * GLINT_WIDTH];
        uint state = 1;
        for (int i = 0; i < rounds; i++) {
            state = state * 1664525u + 1013904223u;
        }
        const real zero = real_of(0);
        probe_store4(out, packet, real3_of(real_of((scalar)(state >> 8)), zero, zero), zero);
    }
}
