// Scenes without some of their nodes. See subset.h.
#include "scene/subset.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool bears_name(const glint_instance *instance, const char *name)
{
    return instance->node != NULL && strcmp(instance->node, name) == 0;
}

// Marks the instances of a node, by its name or else by its index. False where there is none.
static bool mark(const glint_scene *scene, const char *node, bool *is_marked)
{
    bool is_found = false;
    for (size_t i = 0; i < scene->instance_count; i++) {
        is_marked[i] = bears_name(&scene->instances[i], node);
        is_found = is_found || is_marked[i];
    }
    char *rest;
    const long index = strtol(node, &rest, 10);
    const bool is_index = !is_found && rest != node && *rest == '\0';
    for (size_t i = 0; is_index && i < scene->instance_count; i++) {
        is_marked[i] = scene->instances[i].node_index == index;
        is_found = is_found || is_marked[i];
    }
    return is_found;
}

static glint_status refuse(const glint_scene *scene, const char *node, glint_error *error)
{
    char names[GLINT_MESSAGE_CAPACITY / 2] = "";
    size_t length = 0;
    int last = -1;
    for (size_t i = 0; i < scene->instance_count && length + 80 < sizeof names; i++) {
        const glint_instance *instance = &scene->instances[i];
        if (instance->node_index == last) { // another primitive of the same
            continue;
        }
        last = instance->node_index;
        const int written = snprintf(
            names + length, sizeof names - length, "%s%d%s%.60s%s", length > 0 ? ", " : "", last,
            instance->node != NULL ? " \"" : "", instance->node != NULL ? instance->node : "",
            instance->node != NULL ? "\"" : "");
        length += written > 0 ? (size_t)written : 0;
    }
    return glint_fail(error, GLINT_BAD_INPUT, "%s: no node \"%s\" has triangles (there is %s)",
                      scene->path != NULL ? scene->path : "the scene", node,
                      length > 0 ? names : "none that has");
}

// The bounds of some instances: of those that are marked, or of the others.
static void find_bounds(const glint_scene *scene, const bool *is_marked, bool wanted,
                        glint_vec3 *low, glint_vec3 *high)
{
    const double unit = scene->unit > 0 ? scene->unit : 1;
    *low = (glint_vec3){INFINITY, INFINITY, INFINITY};
    *high = (glint_vec3){-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        const float *p = scene->positions + 9 * instance->first_triangle;
        for (size_t v = 0; is_marked[i] == wanted && v < 3 * instance->triangle_count; v++) {
            const glint_vec3 at = {scene->origin.x + unit * (double)p[3 * v],
                                   scene->origin.y + unit * (double)p[3 * v + 1],
                                   scene->origin.z + unit * (double)p[3 * v + 2]};
            *low = (glint_vec3){fmin(low->x, at.x), fmin(low->y, at.y), fmin(low->z, at.z)};
            *high = (glint_vec3){fmax(high->x, at.x), fmax(high->y, at.y), fmax(high->z, at.z)};
        }
    }
}

// Moves what is left together. Instances stand in the order of their triangles.
static void drop(glint_scene *scene, const bool *is_marked)
{
    size_t triangles = 0, kept = 0;
    for (size_t i = 0; i < scene->instance_count; i++) {
        glint_instance instance = scene->instances[i];
        const size_t from = instance.first_triangle, count = instance.triangle_count;
        if (is_marked[i]) {
            free(instance.node);
            continue;
        }
        memmove(scene->positions + 9 * triangles, scene->positions + 9 * from,
                9 * count * sizeof *scene->positions);
        if (scene->normals != NULL) {
            memmove(scene->normals + 9 * triangles, scene->normals + 9 * from,
                    9 * count * sizeof *scene->normals);
        }
        memmove(scene->material_of + triangles, scene->material_of + from,
                count * sizeof *scene->material_of);
        instance.first_triangle = triangles;
        scene->instances[kept++] = instance;
        triangles += count;
    }
    scene->instance_count = kept;
    scene->triangle_count = triangles;
}

glint_status glint_scene_remove_node(glint_scene *scene, const char *node, glint_vec3 *low,
                                     glint_vec3 *high, glint_error *error)
{
    bool *is_marked = glint_allocate(scene->instance_count + 1, sizeof *is_marked);
    if (is_marked == NULL) {
        return glint_fail_memory(error, "the scene's nodes");
    }
    if (!mark(scene, node, is_marked)) {
        free(is_marked);
        return refuse(scene, node, error);
    }
    glint_vec3 unused[2];
    find_bounds(scene, is_marked, true, low != NULL ? low : &unused[0],
                high != NULL ? high : &unused[1]);
    find_bounds(scene, is_marked, false, &scene->low, &scene->high);
    drop(scene, is_marked);
    free(is_marked);
    return GLINT_OK;
}
