// Shades surfaces whose light was found at their vertices (vertices.cl). Pixels interpolate between
// the corners of the triangle that they see. See layout.h, "Vertices".
#define SHADES_VERTICES ((GLINT_VERTEX_COLOR || GLINT_VERTEX_DIRECTION) && !GLINT_HITS)
#if SHADES_VERTICES

#if GLINT_VERTEX_COLOR
#define VERTEX_VECTORS GLINT_VERTEX_COLOR_VECTORS
#else
#define VERTEX_VECTORS GLINT_VERTEX_VECTORS
#endif
// The number of floats of a cluster's vertices.
#define VERTEX_CLUSTER_VALUES (3 * VERTEX_VECTORS * GLINT_CLUSTER_LANES)

// All vectors of the vertices, interpolated at the hits of the rays in `met`.
static inline void interpolate_corners(const scene_buffers *scene, const closest *hit, mask met,
                                       real3 results[VERTEX_VECTORS])
{
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    const real weights[3] = {R(1.0) - hit->b1 - hit->b2, hit->b1, hit->b2};
    for (int i = 0; i < VERTEX_VECTORS; i++) {
        results[i] = zero;
    }
    uint left = mask_bits(met);
    while (left != 0) {
        int first;
        mask here = next_alike(hit->place >> FETCHED_BITS, &left, &first);
        first <<= FETCHED_BITS;
        const choice triangles = choice_of(hit->place, first);
        const size_t cluster = (size_t)first / GLINT_CLUSTER_LANES;
        global const uchar *corners =
            (global const uchar *)(scene->clusters + cluster * GLINT_CLUSTER_VALUES +
                                   GLINT_CLUSTER_CORNERS);
        global const float *values = scene->vertices + cluster * VERTEX_CLUSTER_VALUES;
#pragma unroll
        for (int k = 0; k < 3; k++) {
            const choice corner = corner_at(corners + k * GLINT_CLUSTER_LANES, triangles);
            for (int i = 0; i < VERTEX_VECTORS; i++) {
                real3 vector = zero;
                set_vertex(values + 3 * i * GLINT_CLUSTER_LANES, corner, here, &vector);
                results[i] = scale_add(vector, weights[k], results[i]);
            }
        }
    }
}

// A sum of directions can be 0, as between opposite directions. Then `other` replaces it.
static inline real3 some_direction(real3 sum, real3 other)
{
    return select3(is_zero3(sum), other, sum);
}

// Interpolates the light and the look-ups' directions of surfaces that the rays in `met` have met.
// The interpolated directions are not normalised.
static inline scattering scatter_from_corners(const scene_buffers *scene,
                                              const glint_frame_record *frame, const path *ray,
                                              const surface *s, const closest *hit, mask met)
{
    real3 vectors[VERTEX_VECTORS];
    interpolate_corners(scene, hit, met, vectors);
    scattering result;
    result.emitted = vectors[GLINT_VERTEX_EMITTED];
    result.media_reflected = ray->media;
    result.media_transmitted = ray->media;
    result.total_reflection = mask_none();
    result.eta = real_of(1);
    result.bend = real_of(0);
#if GLINT_VERTEX_COLOR
    const real3 nothing = real3_of(real_of(0), real_of(0), real_of(0));
    result.reflected = s->normal;
    result.reflected_weight = nothing;
    result.transmitted = s->normal;
    result.transmitted_weight = nothing;
#else
    if (NEEDS_IRRADIANCE) {
        mask valid;
        const real3 n = normalized(vectors[GLINT_VERTEX_NORMAL], &valid);
        const real3 irradiance =
            find_irradiance(scene, turn_into_environment(frame, select3(valid, n, s->normal)), met);
        result.emitted = add(result.emitted, multiply(vectors[GLINT_VERTEX_LIT], irradiance));
    }
    result.reflected = some_direction(vectors[GLINT_VERTEX_REFLECTED], s->normal);
    result.reflected_weight = vectors[GLINT_VERTEX_REFLECTED_WEIGHT];
    result.transmitted = some_direction(vectors[GLINT_VERTEX_TRANSMITTED], ray->direction);
    result.transmitted_weight = vectors[GLINT_VERTEX_TRANSMITTED_WEIGHT];
#endif
    return result;
}
#endif
