// Loads the triangles that rays hit from their clusters.

// The corners of the triangles hit, and their normals; zeros for rays that hit nothing.
typedef struct triangle {
    real3 vertices[3];
#if GLINT_LOCAL_ORIGINS
    real3 anchor; // origin of the vertices' coordinates
#endif
#if GLINT_SMOOTH_NORMALS
    real3 normals[3];
#endif
#if GLINT_MANY_MATERIALS
    lanes_int material;
#endif
#if GLINT_HITS
    real number; // in the scene
#endif
} triangle;

// Chooses which of a cluster's 16 values each ray takes, for its triangles or its vertices.
// Neighbouring rays tend to hit the same triangles, so shared data is fetched once. If the target
// has an instruction that permutes vectors, the code fetches a whole cluster and each ray takes its
// value. Otherwise it fetches one triangle at a time, whose values all its rays take.
#if HAS_MASK_REGISTERS && GLINT_WIDTH == 16
#define FETCHED_BITS 4 // low bits of a place; one fetch serves all their values
typedef lanes_int choice;
static inline choice choice_of(lanes_int places, int first) { return places; }
static inline real value_at(global const float *values, choice which)
{
    return __builtin_ia32_permvarsf512(vload16(0, values), which);
}
static inline real number_at(global const int *numbers, choice which)
{
    return to_real(__builtin_ia32_permvarsi512(vload16(0, numbers), which));
}
static inline choice corner_at(global const uchar *corners, choice which)
{
    return __builtin_ia32_permvarsi512(convert_int16(vload16(0, corners)), which);
}
#else
#define FETCHED_BITS 0
typedef int choice;
static inline choice choice_of(lanes_int places, int first) { return first % GLINT_CLUSTER_LANES; }
static inline real value_at(global const float *values, choice which)
{
    return real_of(values[which]);
}
static inline real number_at(global const int *numbers, choice which)
{
    return real_of((scalar)numbers[which]);
}
static inline choice corner_at(global const uchar *corners, choice which) { return corners[which]; }
#endif

// Sets a vertex's coordinates from x[16] y[16] z[16] for the rays in `yes`.
static inline void set_vertex(global const float *values, choice corner, mask yes, real3 *vertex)
{
    vertex->x = SELECT(yes, value_at(values, corner), vertex->x);
    vertex->y = SELECT(yes, value_at(values + GLINT_CLUSTER_LANES, corner), vertex->y);
    vertex->z = SELECT(yes, value_at(values + 2 * GLINT_CLUSTER_LANES, corner), vertex->z);
}

// The triangles at the places of the rays in `met`.
static inline triangle load_triangles(const scene_buffers *scene, lanes_int places, mask met)
{
    const real3 zero = real3_of(real_of(0), real_of(0), real_of(0));
    triangle t;
#pragma unroll
    for (int k = 0; k < 3; k++) {
        t.vertices[k] = zero;
#if GLINT_SMOOTH_NORMALS
        t.normals[k] = zero;
#endif
    }
#if GLINT_LOCAL_ORIGINS
    t.anchor = zero;
#endif
#if GLINT_MANY_MATERIALS
    t.material = int_of(0);
#endif
#if GLINT_HITS
    t.number = real_of(-1);
#endif
    uint left = mask_bits(met);
    while (left != 0) {
        int first;
        mask here = next_alike(places >> FETCHED_BITS, &left, &first);
        first <<= FETCHED_BITS;
        const choice triangles = choice_of(places, first);
        const size_t cluster = (size_t)first / GLINT_CLUSTER_LANES;
        global const float *values = scene->clusters + cluster * GLINT_CLUSTER_VALUES;
        global const uchar *corners = (global const uchar *)(values + GLINT_CLUSTER_CORNERS);
#if GLINT_MANY_MATERIALS
        t.material = SELECT(here, int_of(material_of_cluster(values)), t.material);
#endif
#if GLINT_LOCAL_ORIGINS
        global const float *anchor = values + GLINT_CLUSTER_ANCHOR;
        t.anchor.x = SELECT(here, real_of(anchor[0]), t.anchor.x);
        t.anchor.y = SELECT(here, real_of(anchor[1]), t.anchor.y);
        t.anchor.z = SELECT(here, real_of(anchor[2]), t.anchor.z);
#endif
#if GLINT_HITS
        global const int *numbers = scene->numbers + cluster * GLINT_CLUSTER_LANES;
        t.number = SELECT(here, number_at(numbers, triangles), t.number);
#endif
#pragma unroll
        for (int k = 0; k < 3; k++) {
            const choice corner = corner_at(corners + k * GLINT_CLUSTER_LANES, triangles);
            set_vertex(values, corner, here, &t.vertices[k]);
#if GLINT_SMOOTH_NORMALS
            if (HAS(SMOOTH_NORMALS)) {
                set_vertex(scene->normals + cluster * GLINT_CLUSTER_NORMALS, corner, here,
                           &t.normals[k]);
            }
#endif
        }
    }
    return t;
}
