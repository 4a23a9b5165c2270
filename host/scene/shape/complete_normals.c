// Computes a normal for every vertex. See complete_normals.h.
#include "scene/shape/complete_normals.h"

#include "base/memory.h"
#include "base/vector.h"

static glint_vec3 vertex(const float *values)
{
    return (glint_vec3){(double)values[0], (double)values[1], (double)values[2]};
}

// The unit normal of a triangle's plane, on the side from which the triangle winds
// counter-clockwise.
static glint_vec3 plane_normal(const float *corners)
{
    const glint_vec3 a = vertex(corners), b = vertex(corners + 3), c = vertex(corners + 6);
    const glint_vec3 n = glint_vec3_cross(glint_vec3_subtract(b, a), glint_vec3_subtract(c, a));
    const double length = glint_vec3_length(n);
    return length > 0 ? glint_vec3_scale(n, 1 / length) : (glint_vec3){0, 0, 0};
}

static bool is_given(const float *normal)
{
    return normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
}

static void complete(glint_vec3 plane, const float *given, float *normals)
{
    const bool smooth =
        given != NULL && is_given(given) && is_given(given + 3) && is_given(given + 6);
    for (int k = 0; k < 9; k += 3) {
        glint_vec3 n = smooth ? vertex(given + k) : plane;
        if (glint_vec3_dot(n, plane) < 0) {
            n = glint_vec3_scale(n, -1);
        }
        normals[k] = (float)n.x;
        normals[k + 1] = (float)n.y;
        normals[k + 2] = (float)n.z;
    }
}

glint_status glint_scene_complete_normals(const glint_scene *scene, float **normals,
                                          glint_error *error)
{
    *normals = NULL;
    if (scene->triangle_count == 0) {
        return GLINT_OK;
    }
    *normals = glint_allocate_unset(scene->triangle_count, 9 * sizeof **normals);
    if (*normals == NULL) {
        return glint_fail_memory(error, "the vertices' normals");
    }
    for (size_t i = 0; i < scene->triangle_count; i++) {
        complete(plane_normal(scene->positions + 9 * i),
                 scene->normals != NULL ? scene->normals + 9 * i : NULL, *normals + 9 * i);
    }
    return GLINT_OK;
}
