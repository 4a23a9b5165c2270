// Computes a normal for every vertex. See complete_normals.h.
#include "scene/shape/complete_normals.h"

#include "base/memory.h"
#include "base/vector.h"

// The unit normal of a triangle's plane, on the side from which the triangle winds
// counter-clockwise.
static glint_vec3 plane_normal(const glint_scene *scene, size_t triangle)
{
    const glint_vec3 a = glint_vec3_from_floats(glint_scene_position(scene, triangle, 0));
    const glint_vec3 b = glint_vec3_from_floats(glint_scene_position(scene, triangle, 1));
    const glint_vec3 c = glint_vec3_from_floats(glint_scene_position(scene, triangle, 2));
    const glint_vec3 n = glint_vec3_cross(glint_vec3_subtract(b, a), glint_vec3_subtract(c, a));
    const double length = glint_vec3_length(n);
    return length > 0 ? glint_vec3_scale(n, 1 / length) : (glint_vec3){0, 0, 0};
}

static bool is_smooth(const glint_scene *scene, size_t triangle)
{
    bool smooth = scene->normals != NULL;
    for (size_t k = 0; smooth && k < 3; k++) {
        const float *n = glint_scene_normal(scene, triangle, k);
        smooth = n[0] != 0 || n[1] != 0 || n[2] != 0;
    }
    return smooth;
}

static void complete(const glint_scene *scene, size_t triangle, float *normals)
{
    const glint_vec3 plane = plane_normal(scene, triangle);
    const bool smooth = is_smooth(scene, triangle);
    for (size_t k = 0; k < 3; k++) {
        glint_vec3 n =
            smooth ? glint_vec3_from_floats(glint_scene_normal(scene, triangle, k)) : plane;
        if (glint_vec3_dot(n, plane) < 0) {
            n = glint_vec3_scale(n, -1);
        }
        normals[3 * k] = (float)n.x;
        normals[3 * k + 1] = (float)n.y;
        normals[3 * k + 2] = (float)n.z;
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
        complete(scene, i, *normals + 9 * i);
    }
    return GLINT_OK;
}
