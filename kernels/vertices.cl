// Shades once per vertex and view instead of once per pixel (--shading vertex-color and
// vertex-direction). `shade_vertices` runs before the tiles of a frame. For every vertex it finds
// the light on a ray from the eye to the vertex, with the same optics. Pixels interpolate the
// results (corners.cl). Vertices are few and far between, so surfaces see only the environment.
#if SHADES_VERTICES

// Loads a packet of a cluster's 16 vertices, from `first` on; `values` are x[16], y[16], z[16].
static inline real load_vertices(global const float *values, int first)
{
    real loaded;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        LANE(loaded, lane) = (scalar)values[first + lane];
    }
    return loaded;
}

static inline real3 load_vertices3(global const float *values, int first)
{
    return real3_of(load_vertices(values, first),
                    load_vertices(values + GLINT_CLUSTER_LANES, first),
                    load_vertices(values + 2 * GLINT_CLUSTER_LANES, first));
}

// Stores vector number `which` of the vertices.
static inline void store_vertices(global float *values, int which, int first, real3 vector)
{
    global float *x = values + 3 * which * GLINT_CLUSTER_LANES + first;
    for (int lane = 0; lane < GLINT_WIDTH; lane++) {
        x[lane] = (float)LANE(vector.x, lane);
        x[lane + GLINT_CLUSTER_LANES] = (float)LANE(vector.y, lane);
        x[lane + 2 * GLINT_CLUSTER_LANES] = (float)LANE(vector.z, lane);
    }
}

// Makes the rays from the eye to the vertices, like primary rays, and their distances. In image
// coordinates (glint_frame_record), the vector from the eye to the vertex is h times the direction
// of the primary ray through (x/h, y/h). So no division is needed. Vertices behind the eye also get
// a ray, because pixels interpolate towards them.
static inline path rays_to_vertices(const glint_frame_record *frame, real3 vertices, real *distance)
{
    const real3 p = subtract(vertices, join_vector(&frame->origin));
    const real x = dot3(join_vector(&frame->image_x), p), y = dot3(join_vector(&frame->image_y), p);
    const real z = dot3(join_vector(&frame->image_z), p);
    const real h =
        fused(z, (scalar)frame->image_slope, JOIN(frame->image_offset[0], frame->image_offset[1]));
    const real3 d = scale_add(
        join_vector(&frame->direction_y), y,
        scale_add(join_vector(&frame->direction_x), x, scale(join_vector(&frame->direction), h)));
    mask valid, always;
    path ray = path_at_start();
    ray.direction = normalized(d, &valid);
    ray.direction = select3(valid, ray.direction, // a vertex at the eye gets the middle ray
                            normalized(join_vector(&frame->direction), &always));
    const real length = sqrt(dot3(d, d));
    const real depth = z + JOIN(frame->start[0], frame->start[1]);
    *distance = frame->image_slope > 0 ? length : fabs(depth / h) * length;
    return ray;
}

// The vertices of a cluster, as bits, that belong to a triangle seen from its outside (from which
// it winds left). Such a triangle shows its outside, even if the normal of a corner already points
// away from the eye. All other vertices are seen from inside.
static inline uint seen_from_outside(const glint_frame_record *frame, global const float *vertices)
{
    global const uchar *corners = (global const uchar *)(vertices + GLINT_CLUSTER_CORNERS);
    const int count = count_of_cluster(vertices);
    uint seen = 0;
    for (int i = 0; i < count; i++) {
        real3 p[3];
        uint bits = 0;
        for (int k = 0; k < 3; k++) {
            const int lane = corners[k * GLINT_CLUSTER_LANES + i];
            p[k] = real3_of(real_of(vertices[lane]), real_of(vertices[GLINT_CLUSTER_LANES + lane]),
                            real_of(vertices[2 * GLINT_CLUSTER_LANES + lane]));
            bits |= 1u << lane;
        }
        real distance;
        const path ray = rays_to_vertices(frame, p[0], &distance);
        seen |= any_lane(dot3(normal_of(p), ray.direction) < R(0.0)) ? bits : 0;
    }
    return seen;
}

// A hit at the vertices of a cluster, from lane `first` on.
static inline surface surface_at_vertices(const scene_buffers *scene, real3 normals, int material,
                                          real3 v, uint from_outside, int first)
{
    surface s;
    const mask away = dot3(normals, v) < R(0.0);
    s.outside = ((int_of((lane_int)from_outside) >> (lane_numbers() + (lane_int)first)) &
                 (lane_int)1) != (lane_int)0;
    s.normal = select3(away, negate(normals), normals);
    s.normal = select3(is_zero3(normals), v, s.normal); // a triangle without area has no normal
    s.geometric_normal = s.lit_normal = s.normal;
    s.cosine = SMALLER(fabs(dot3(s.normal, v)), real_of(1));
    set_material(scene, &s, mask_all(), scene->materials + (GLINT_MANY_MATERIALS ? material : 0));
    return s;
}

// Finds the light that the surfaces add themselves. *lit is the light that they reflect of an
// irradiance of 1.
static inline scattering scatter_at_vertices(const scene_buffers *scene, const surface *s,
                                             path *ray, real3 *lit)
{
    const real zero = real_of(0), one = real_of(1);
    mask media_lost;
    lanes_int media = ray->media;
    *lit = scatter(scene, s, negate(ray->direction), &media, real3_of(one, one, one), &media_lost)
               .emitted;
    const scattering out = scatter(scene, s, negate(ray->direction), &ray->media,
                                   real3_of(zero, zero, zero), &media_lost);
    *lit = subtract(*lit, out.emitted);
    return out;
}

// The radiance of the environment along d, multiplied by the weight.
static inline real3 weighted_radiance(const scene_buffers *scene, const glint_frame_record *frame,
                                      real3 d, real3 weight)
{
    const mask wanted = largest3(weight) > R(0.0);
    const real3 light = sample_cube(&scene->environment, turn_into_environment(frame, d), wanted);
    return multiply(weight, light);
}

// Shades a packet of a cluster's vertices, from lane `first` on.
static NOT_INLINED void shade_packet(const scene_buffers *scene, const glint_frame_record *frame,
                                size_t cluster, int first, global float *values)
{
    global const float *vertices = scene->clusters + cluster * GLINT_CLUSTER_VALUES;
    const int material = material_of_cluster(vertices);
    // Make the rays and the surfaces at the vertices.
    real distance;
    path ray = rays_to_vertices(frame, load_vertices3(vertices, first), &distance);
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    mask valid;
    real3 n =
        normalized(load_vertices3(scene->normals + cluster * GLINT_CLUSTER_NORMALS, first), &valid);
    n = select3(valid, n, zero);
    const surface s = surface_at_vertices(scene, n, material, negate(ray.direction),
                                          seen_from_outside(frame, vertices), first);
    // Light reaches paint on the visible side, even if the normal points away from the viewer.
    const real3 lit_side = select3(s.outside, n, negate(n));
    real3 lit;
    const scattering out = scatter_at_vertices(scene, &s, &ray, &lit);
    // Apply absorption between the eye and the vertex.
#if GLINT_ABSORPTION
    const real3 left = absorbed_weight(scene, &ray, distance);
#else
    const real3 left = ray.weight;
#endif
    const real3 emitted = multiply(left, out.emitted);
    lit = multiply(left, lit);
    const real3 reflected_weight = multiply(left, out.reflected_weight);
    const real3 transmitted_weight = multiply(left, out.transmitted_weight);
    // Store the colour, or its parts and directions.
#if GLINT_VERTEX_COLOR
    real3 color = add(emitted, weighted_radiance(scene, frame, out.reflected, reflected_weight));
    if (GLINT_GLASS) {
        color = add(color, weighted_radiance(scene, frame, out.transmitted, transmitted_weight));
    }
    if (NEEDS_IRRADIANCE) {
        const real3 irradiance =
            find_irradiance(scene, turn_into_environment(frame, lit_side), mask_all());
        color = add(color, multiply(lit, irradiance));
    }
    store_vertices(values, GLINT_VERTEX_EMITTED, first, color);
#else
    store_vertices(values, GLINT_VERTEX_EMITTED, first, emitted);
    store_vertices(values, GLINT_VERTEX_LIT, first, lit);
    store_vertices(values, GLINT_VERTEX_NORMAL, first, lit_side);
    store_vertices(values, GLINT_VERTEX_REFLECTED, first, out.reflected);
    store_vertices(values, GLINT_VERTEX_REFLECTED_WEIGHT, first, reflected_weight);
    if (GLINT_GLASS) {
        store_vertices(values, GLINT_VERTEX_TRANSMITTED, first, out.transmitted);
        store_vertices(values, GLINT_VERTEX_TRANSMITTED_WEIGHT, first, transmitted_weight);
    }
#endif
}

// Shades the vertices of one cluster per work-item, for `count` clusters.
kernel void shade_vertices(GLINT_SCENE_ARGUMENTS(PARAMETER) const int count,
                           const glint_frame_record frame)
{
    if (get_global_id(0) >= (size_t)count) {
        return;
    }
    const scene_buffers scene = SCENE_OF_ARGUMENTS;
    const size_t cluster = get_global_id(0);
    for (int first = 0; first < GLINT_CLUSTER_LANES; first += GLINT_WIDTH) {
        shade_packet(&scene, &frame, cluster, first, vertices + cluster * VERTEX_CLUSTER_VALUES);
    }
}
#endif
