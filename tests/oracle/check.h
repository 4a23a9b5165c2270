// Helpers of the oracle's own tests: comparisons, closed-form environments, and a record of the
// directions of all environment look-ups.
#ifndef GLINT_TESTS_ORACLE_CHECK_H
#define GLINT_TESTS_ORACLE_CHECK_H

#include "meshes.h"
#include "oracle/oracle.h"
#include "oracle/vector.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define CHECK_PI 3.14159265358979323846
#define RADIANS(degrees) ((degrees)*CHECK_PI / 180.0)

// Fails for NaN.
#define assert_close(value, expected, tolerance)                                                   \
    do {                                                                                           \
        double value_ = (value), expected_ = (expected), tolerance_ = (tolerance);                 \
        if (!(fabs(value_ - expected_) <= tolerance_))                                             \
            fail_msg("%s = %.17g, expected %.17g ± %g", #value, value_, expected_, tolerance_);    \
    } while (0)

// Context of the environments: the number and directions of look-ups.
typedef struct record {
    double direction[256][3];
    int count;
} record;

static inline void record_add(const void *context, const double direction[3])
{
    // A callback's context is const, but this context is the test's own and writable.
    record *r = (record *)(uintptr_t)context;
    if (r && r->count < 256)
        vector_store(vector_of(direction), r->direction[r->count++]);
}

// E = 1 everywhere.
static inline void light_white(const void *context, const double direction[3], double rgb[3])
{
    record_add(context, direction);
    rgb[0] = rgb[1] = rgb[2] = 1.0;
}

// The irradiance of light_white over π. Irradiance look-ups keep no record.
static inline void light_white_mean(const void *context, const double normal[3], double rgb[3])
{
    (void)context;
    (void)normal;
    rgb[0] = rgb[1] = rgb[2] = 1.0;
}

// E(d) = ½ + ½d.
static inline void light_direction(const void *context, const double direction[3], double rgb[3])
{
    record_add(context, direction);
    for (int i = 0; i < 3; i++)
        rgb[i] = 0.5 + 0.5 * direction[i];
}

// The irradiance of light_direction over π: the cosine-weighted mean of d about n is ⅔n.
static inline void light_direction_mean(const void *context, const double normal[3], double rgb[3])
{
    (void)context;
    for (int i = 0; i < 3; i++)
        rgb[i] = 0.5 + normal[i] / 3.0;
}

// 1 below the horizon, 0 above.
static inline void light_below(const void *context, const double direction[3], double rgb[3])
{
    record_add(context, direction);
    rgb[0] = rgb[1] = rgb[2] = direction[1] < 0.0 ? 1.0 : 0.0;
}

// Makes a scene of a mesh and materials under E = 1.
static inline oracle_scene scene_of(const mesh *m, const oracle_material *materials)
{
    return (oracle_scene){.triangles = m->triangles,
                          .triangle_count = m->count,
                          .materials = materials,
                          .radiance = light_white,
                          .irradiance = light_white_mean};
}

static inline oracle_material glass_of(double ior, double thickness)
{
    oracle_material m = oracle_material_default;
    m.transmission = 1.0;
    m.ior = ior;
    m.thickness = thickness;
    return m;
}

// Reflectance of an interface at normal incidence.
static inline double normal_fresnel(double ior)
{
    return (ior - 1.0) / (ior + 1.0) * ((ior - 1.0) / (ior + 1.0));
}

static inline oracle_material blend_of(double mirror)
{
    oracle_material m = oracle_material_default;
    m.base[0] = m.base[1] = m.base[2] = 0.0;
    m.mirror = mirror;
    return m;
}

static inline double angle_between(const double a[3], const double b[3])
{
    // atan2 keeps its precision at 0 and at π. acos loses half of the digits there.
    vector u = vector_of(a), v = vector_of(b);
    return atan2(length(cross(u, v)), dot(u, v));
}

// The angle between `direction` and the nearest recorded direction.
static inline double nearest_recorded(const record *r, const double direction[3])
{
    double least = INFINITY;
    for (int i = 0; i < r->count; i++)
        least = fmin(least, angle_between(r->direction[i], direction));
    return least;
}

// A random double in [0, 1) by splitmix64, the same on every machine.
static inline double random_unit(uint64_t *state)
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline void random_direction(uint64_t *state, double direction[3])
{
    double y = 2.0 * random_unit(state) - 1.0, around = 2.0 * CHECK_PI * random_unit(state);
    double ring = sqrt(1.0 - y * y);
    direction[0] = ring * cos(around);
    direction[1] = y;
    direction[2] = ring * sin(around);
}

#endif
