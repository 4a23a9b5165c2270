// Removes some of a scene's nodes, or all others. See subset.h.
#include "scene/subset.h"

#include "base/memory.h"
#include "base/option.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NO_VERTEX 0xFFFFFFFFu

// True if an instance belongs to a node or to a node below it. `name` names the node; if it is
// NULL, its index counts.
static bool stands_under(const glint_scene *scene, const glint_instance *instance, const char *name,
                         long long index)
{
    int at = instance->node_index;
    while (scene->nodes != NULL && at >= 0) {
        const glint_node *node = &scene->nodes[at];
        if (name == NULL ? at == index : node->name != NULL && strcmp(node->name, name) == 0) {
            return true;
        }
        at = node->parent;
    }
    return scene->nodes == NULL && name == NULL && instance->node_index == index;
}

static bool mark_by(const glint_scene *scene, const char *name, long long index, bool *is_marked)
{
    bool is_found = false;
    for (size_t i = 0; i < scene->instance_count; i++) {
        const bool is_it = stands_under(scene, &scene->instances[i], name, index);
        is_marked[i] = is_marked[i] || is_it;
        is_found = is_found || is_it;
    }
    return is_found;
}

static bool has_name(const glint_scene *scene, const char *name)
{
    bool has = false;
    for (size_t i = 0; i < scene->node_count; i++) {
        has = has || (scene->nodes[i].name != NULL && strcmp(scene->nodes[i].name, name) == 0);
    }
    return has;
}

// Marks the instances of a node: of all nodes with the name, else of the node with the index.
// Returns false if there is no such node, or it has no triangles at any time. Visibility now does
// not matter.
static bool mark(const glint_scene *scene, const char *node, bool *is_marked)
{
    if (has_name(scene, node)) {
        return mark_by(scene, node, 0, is_marked) || scene->moves;
    }
    long long index;
    return glint_parse_int(node, &index) &&
           (mark_by(scene, NULL, index, is_marked) ||
            (scene->moves && index >= 0 && index < (long long)scene->node_count));
}

static glint_status refuse(const glint_scene *scene, const char *node, glint_error *error)
{
    char names[GLINT_MESSAGE_CAPACITY / 2] = "";
    size_t length = 0;
    int last = -1;
    for (size_t i = 0; i < scene->instance_count && length + 80 < sizeof names; i++) {
        const glint_instance *instance = &scene->instances[i];
        if (instance->node_index == last) { // another primitive of the same node
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

// Marks the instances of all nodes of a list. The caller frees the marks in any case.
static glint_status mark_nodes(const glint_scene *scene, const char *nodes, bool **is_marked,
                               glint_error *error)
{
    glint_status status = GLINT_OK;
    char *names = strdup(nodes);
    *is_marked = glint_allocate(scene->instance_count + 1, sizeof **is_marked);
    if (names == NULL || *is_marked == NULL) {
        free(names);
        return glint_fail_memory(error, "the scene's nodes");
    }
    char *rest = names, *name;
    while (status == GLINT_OK && (name = strsep(&rest, ",")) != NULL) {
        if (!mark(scene, name, *is_marked)) {
            status = refuse(scene, name, error);
        }
    }
    free(names);
    return status;
}

// Computes the bounds of the instances whose mark is `wanted`.
static void find_bounds(const glint_scene *scene, const bool *is_marked, bool wanted,
                        glint_vec3 *low, glint_vec3 *high)
{
    const double unit = scene->unit > 0 ? scene->unit : 1;
    *low = (glint_vec3){INFINITY, INFINITY, INFINITY};
    *high = (glint_vec3){-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        for (size_t v = 0; is_marked[i] == wanted && v < 3 * instance->triangle_count; v++) {
            const glint_vec3 stored = glint_vec3_from_floats(
                glint_scene_position(scene, instance->first_triangle + v / 3, v % 3));
            const glint_vec3 at = glint_vec3_add(scene->origin, glint_vec3_scale(stored, unit));
            *low = (glint_vec3){fmin(low->x, at.x), fmin(low->y, at.y), fmin(low->z, at.z)};
            *high = (glint_vec3){fmax(high->x, at.x), fmax(high->y, at.y), fmax(high->z, at.z)};
        }
    }
}

// Keeps only the materials still in use.
static void drop_materials(glint_scene *scene, uint32_t *place)
{
    enum { UNUSED, USED };
    for (size_t i = 0; i < scene->instance_count; i++) {
        place[scene->instances[i].material] = USED;
    }
    size_t kept = 0;
    for (size_t m = 0; m < scene->material_count; m++) {
        if (place[m] == UNUSED) {
            free(scene->materials[m].name);
            continue;
        }
        scene->materials[kept] = scene->materials[m];
        place[m] = (uint32_t)kept++;
    }
    scene->material_count = kept;
    for (size_t i = 0; i < scene->instance_count; i++) {
        scene->instances[i].material = place[scene->instances[i].material];
    }
    for (size_t t = 0; t < scene->triangle_count; t++) {
        scene->material_of[t] = place[scene->material_of[t]];
    }
}

// Moves floats of vertices to the vertices' new numbers.
static void move_floats(float *floats, size_t stride, const uint32_t *number, size_t count)
{
    for (size_t v = 0; floats != NULL && v < count; v++) {
        if (number[v] != NO_VERTEX) {
            memmove(floats + stride * number[v], floats + stride * v, stride * sizeof *floats);
        }
    }
}

// Numbers the vertices of the instances that stay, in their order. The others get NO_VERTEX.
// Returns the number of vertices that stay.
static size_t number_vertices(const glint_scene *scene, const bool *is_marked, bool unwanted,
                              uint32_t *number)
{
    const size_t count = glint_scene_vertex_count(scene);
    size_t kept = 0;
    memset(number, 0xFF, count * sizeof *number);
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        for (size_t v = 0; is_marked[i] != unwanted && v < 3 * instance->triangle_count; v++) {
            number[glint_scene_vertex(scene, instance->first_triangle + v / 3, v % 3)] = 0;
        }
    }
    for (size_t v = 0; v < count; v++) {
        number[v] = number[v] != NO_VERTEX ? (uint32_t)kept++ : NO_VERTEX;
    }
    return kept;
}

static void drop_vertices(glint_scene *scene, const uint32_t *number, size_t kept)
{
    const size_t count = glint_scene_vertex_count(scene);
    move_floats(scene->positions, 3, number, count);
    move_floats(scene->normals, 3, number, count);
    move_floats(scene->parts.positions, 3, number, count);
    move_floats(scene->attributes, glint_attributes_stride(&scene->attribute_set), number, count);
    scene->vertex_count = scene->indices != NULL ? kept : 0;
}

static void move_triangles(glint_scene *scene, size_t to, size_t from, size_t count,
                           const uint32_t *number)
{
    memmove(scene->material_of + to, scene->material_of + from, count * sizeof *scene->material_of);
    if (scene->parts.count > 0) {
        memmove(scene->parts.part_of + to, scene->parts.part_of + from,
                count * sizeof *scene->parts.part_of);
    }
    for (size_t i = 0; scene->indices != NULL && i < 3 * count; i++) {
        scene->indices[3 * to + i] = number[scene->indices[3 * from + i]];
    }
}

// Removes the instances whose mark is `unwanted`, and closes the gaps. Instances stand in the order
// of their triangles. Returns false, and changes nothing, if memory is short.
static bool drop(glint_scene *scene, const bool *is_marked, bool unwanted)
{
    size_t triangles = 0, kept = 0;
    uint32_t *number = glint_allocate_unset(glint_scene_vertex_count(scene), sizeof *number);
    if (number == NULL) {
        return false;
    }
    drop_vertices(scene, number, number_vertices(scene, is_marked, unwanted, number));
    for (size_t i = 0; i < scene->instance_count; i++) {
        glint_instance instance = scene->instances[i];
        if (is_marked[i] != unwanted) {
            move_triangles(scene, triangles, instance.first_triangle, instance.triangle_count,
                           number);
            instance.first_triangle = triangles;
            scene->instances[kept++] = instance;
            triangles += instance.triangle_count;
        }
    }
    scene->instance_count = kept;
    scene->triangle_count = triangles;
    free(number);
    return true;
}

// Removes the nodes of a list, or all others.
static glint_status part(glint_scene *scene, const char *nodes, bool keeps, glint_error *error)
{
    uint32_t *place = glint_allocate(scene->material_count + 1, sizeof *place);
    if (place == NULL) {
        return glint_fail_memory(error, "the scene's materials");
    }
    bool *is_marked;
    glint_vec3 low, high;
    glint_status status;
    TRY_OR(cleanup, status, mark_nodes(scene, nodes, &is_marked, error));
    find_bounds(scene, is_marked, keeps, &low, &high);
    if (drop(scene, is_marked, !keeps)) {
        drop_materials(scene, place);
        scene->low = low;
        scene->high = high;
    } else {
        status = glint_fail_memory(error, "the scene's vertices");
    }
cleanup:
    free(place);
    free(is_marked);
    return status;
}

glint_status glint_scene_remove_nodes(glint_scene *scene, const char *nodes, glint_error *error)
{
    return part(scene, nodes, false, error);
}

glint_status glint_scene_keep_nodes(glint_scene *scene, const char *nodes, glint_error *error)
{
    return part(scene, nodes, true, error);
}

glint_status glint_scene_middle_of_nodes(const glint_scene *scene, const char *nodes,
                                         glint_vec3 *middle, glint_error *error)
{
    bool *is_marked;
    glint_vec3 low, high;
    glint_status status;
    TRY_OR(cleanup, status, mark_nodes(scene, nodes, &is_marked, error));
    find_bounds(scene, is_marked, true, &low, &high);
    if (low.x <= high.x) {
        *middle = glint_vec3_scale(glint_vec3_add(low, high), 0.5);
    } else {
        status = glint_fail(error, GLINT_BAD_INPUT,
                            "%s: node \"%s\" has no triangles at this time, and so no middle",
                            scene->path != NULL ? scene->path : "the scene", nodes);
    }
cleanup:
    free(is_marked);
    return status;
}
