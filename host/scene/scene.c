// Frees scenes, computes their bounds, and finds cameras. gltf/open.c loads scenes.
#include "scene/scene.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *glint_treatment_name(glint_treatment treatment)
{
    static const char *const names[] = {
        [GLINT_RENDERED] = "rendered",
        [GLINT_APPROXIMATED] = "approximated",
        [GLINT_IGNORED] = "ignored",
    };
    return names[treatment];
}

const char *glint_punctual_kind_name(glint_punctual_kind kind)
{
    static const char *const names[] = {
        [GLINT_PUNCTUAL_POINT] = "point",
        [GLINT_PUNCTUAL_SPOT] = "spot",
        [GLINT_PUNCTUAL_DIRECTIONAL] = "directional",
    };
    return names[kind];
}

void glint_scene_free(glint_scene *scene)
{
    for (size_t i = 0; i < scene->material_count; i++) {
        free(scene->materials[i].name);
    }
    for (size_t i = 0; i < scene->node_count; i++) {
        free(scene->nodes[i].name);
    }
    for (size_t i = 0; i < scene->camera_count; i++) {
        free(scene->cameras[i].name);
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        free(scene->lights[i].name);
    }
    for (size_t i = 0; i < scene->variant_count; i++) {
        free(scene->variants[i]);
    }
    free(scene->variants);
    for (size_t i = 0; i < scene->usage_count; i++) {
        free(scene->usages[i].name);
    }
    free(scene->usages);
    free(scene->path);
    free(scene->indices);
    free(scene->positions);
    free(scene->normals);
    free(scene->attributes);
    glint_textures_release(scene->textures);
    free(scene->material_of);
    glint_parts_free(&scene->parts);
    free(scene->materials);
    free(scene->nodes);
    free(scene->instances);
    free(scene->cameras);
    free(scene->lights);
    *scene = (glint_scene){0};
}

size_t glint_scene_bytes(const glint_scene *scene)
{
    const bool about_parts = scene->parts.count > 0;
    const size_t words = (scene->indices != NULL ? 3 : 0) + (about_parts ? 2U : 1U);
    const size_t floats = (scene->normals != NULL ? 6U : 3U) + (about_parts ? 3U : 0U) +
                          glint_attributes_stride(&scene->attribute_set);
    return scene->triangle_count * words * sizeof(uint32_t) +
           glint_scene_vertex_count(scene) * floats * sizeof(float);
}

static bool resize(float **array, size_t stride, size_t vertices)
{
    size_t bytes;
    if (*array == NULL || stride == 0 || vertices == 0) {
        return true;
    }
    if (!glint_multiply(vertices, stride * sizeof **array, &bytes)) {
        return false;
    }
    float *resized = realloc(*array, bytes);
    if (resized == NULL) {
        return false;
    }
    *array = resized;
    return true;
}

bool glint_scene_resize_vertices(glint_scene *scene, size_t vertices)
{
    return resize(&scene->positions, 3, vertices) && resize(&scene->normals, 3, vertices) &&
           resize(&scene->parts.positions, 3, vertices) &&
           resize(&scene->attributes, glint_attributes_stride(&scene->attribute_set), vertices);
}

void glint_scene_find_bounds(glint_scene *scene)
{
    const double origin[3] = {scene->origin.x, scene->origin.y, scene->origin.z};
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < 3 * glint_scene_vertex_count(scene); i++) {
        double value = origin[i % 3] + (double)scene->positions[i] * scene->unit;
        low[i % 3] = fmin(low[i % 3], value);
        high[i % 3] = fmax(high[i % 3], value);
    }
    scene->low = (glint_vec3){low[0], low[1], low[2]};
    scene->high = (glint_vec3){high[0], high[1], high[2]};
}

void glint_scene_shown_bounds(const glint_scene *scene, glint_vec3 *low, glint_vec3 *high)
{
    *low = scene->moves ? scene->swept_low : scene->low;
    *high = scene->moves ? scene->swept_high : scene->high;
}

static const glint_camera *find_camera(const glint_scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->camera_count; i++) {
        if (scene->cameras[i].name != NULL && strcmp(scene->cameras[i].name, name) == 0) {
            return &scene->cameras[i];
        }
    }
    // strtoul would also accept a sign and spaces.
    char *end;
    unsigned long index = strtoul(name, &end, 10);
    bool is_number = name[0] >= '0' && name[0] <= '9' && *end == '\0';
    bool found = is_number && index < scene->camera_count;
    return found ? &scene->cameras[index] : NULL;
}

// Copies the found camera; fails if it is lost at this time.
static glint_status take_camera(const glint_scene *scene, const glint_camera *found,
                                glint_camera *camera, glint_error *error)
{
    if (found->is_lost) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: camera %d has no direction at this time (its scale is 0, or not "
                          "finite)",
                          scene->path, (int)(found - scene->cameras));
    }
    *camera = *found;
    return GLINT_OK;
}

glint_status glint_scene_camera(const glint_scene *scene, const char *name, glint_camera *camera,
                                glint_error *error)
{
    *camera = (glint_camera){0};
    if (name == NULL) {
        if (scene->camera_count == 0) {
            glint_vec3 low, high;
            glint_scene_shown_bounds(scene, &low, &high);
            glint_camera_frame_bounds(low, high, camera);
            return GLINT_OK;
        }
        return take_camera(scene, &scene->cameras[0], camera, error);
    }
    const glint_camera *found = find_camera(scene, name);
    if (found != NULL) {
        return take_camera(scene, found, camera, error);
    }
    const char *path = scene->path ? scene->path : "scene";
    if (scene->camera_count == 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: there is no camera \"%.60s\" (the scene has none: without a name, "
                          "one is made that frames it)",
                          path, name);
    }
    char list[600] = "";
    for (size_t i = 0; i < scene->camera_count; i++) {
        glint_list_add(list, sizeof list, (long long)i, scene->cameras[i].name);
    }
    return glint_fail(error, GLINT_BAD_INPUT, "%s: there is no camera \"%.60s\" (there is %s)",
                      path, name, list);
}
