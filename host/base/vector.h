// Vectors and matrices of double, for the host's set-up work. Column vectors: p' = M p.
#ifndef GLINT_BASE_VECTOR_H
#define GLINT_BASE_VECTOR_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_PI 3.14159265358979323846

typedef struct glint_vec3 {
    double x, y, z;
} glint_vec3;

// m[row][column]; the translation is in column 3.
typedef struct glint_mat4 {
    double m[4][4];
} glint_mat4;

static inline glint_vec3 glint_vec3_from_floats(const float values[3])
{
    return (glint_vec3){(double)values[0], (double)values[1], (double)values[2]};
}

static inline glint_vec3 glint_vec3_add(glint_vec3 a, glint_vec3 b)
{
    return (glint_vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline glint_vec3 glint_vec3_subtract(glint_vec3 a, glint_vec3 b)
{
    return (glint_vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline glint_vec3 glint_vec3_scale(glint_vec3 a, double s)
{
    return (glint_vec3){a.x * s, a.y * s, a.z * s};
}

static inline double glint_vec3_dot(glint_vec3 a, glint_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline glint_vec3 glint_vec3_cross(glint_vec3 a, glint_vec3 b)
{
    return (glint_vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double glint_vec3_length(glint_vec3 a)
{
    return hypot(hypot(a.x, a.y), a.z);
}

// Returns the unit vector along `a`, or (0, 0, 0) for zero, infinite or NaN components.
glint_vec3 glint_vec3_normalize(glint_vec3 a);

// True if the corners (all finite) are not in line. The test is exact if they lie within 2^29 of
// one another; farther apart, their differences are rounded.
bool glint_triangle_has_area(const float a[3], const float b[3], const float c[3]);

// Returns the vertex at corner 0, 1 or 2 of a triangle. `indices` are [triangle][3]; NULL: corner c
// of triangle t is vertex 3 t + c.
static inline size_t glint_triangle_vertex(const uint32_t *indices, size_t triangle, size_t corner)
{
    const size_t at = 3 * triangle + corner;
    return indices != NULL ? indices[at] : at;
}

extern const glint_mat4 glint_mat4_identity;

glint_mat4 glint_mat4_multiply(const glint_mat4 *a, const glint_mat4 *b);
glint_vec3 glint_mat4_point(const glint_mat4 *a, glint_vec3 p);
glint_vec3 glint_mat4_direction(const glint_mat4 *a, glint_vec3 d); // ignores the translation

// The determinant of the upper left 3 × 3.
double glint_mat4_determinant3(const glint_mat4 *a);

// Applies the cofactor matrix of the upper left 3 × 3, which is its inverse transpose times its
// determinant. It turns normals without a division, even if the matrix is singular. The result is
// multiplied by the sign of the determinant, so that a mirrored mesh keeps its normals outside.
glint_vec3 glint_mat4_normal(const glint_mat4 *a, glint_vec3 n);

#ifdef __cplusplus
}
#endif

#endif
