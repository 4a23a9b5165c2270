// Finds components, instance by instance. Solids are then looked at across instances: open surfaces
// of several primitives may be closed together. See welding.h and components.h. O(n log n) in time,
// about 180 bytes in memory per triangle of the largest instance, or of all open solids, and 8 per
// vertex of the scene.
#include "scene/shape/topology.h"

#include "base/memory.h"
#include "scene/shape/components.h"
#include "scene/shape/welding.h"

#include <stdlib.h>
#include <string.h>

#define NONE 0xFFFFFFFFu

// The work on one list of triangles after the other.
typedef struct finding {
    const glint_scene *scene;
    glint_topology *topology;
    glint_welding weld;
    glint_components components;
    uint32_t *list; // [triangle of the scene]
    uint32_t count;
    uint32_t *kind_of;  // [material]: the first material of a solid with the same medium
    bool has_instances; // the list has triangles of several instances
} finding;

static bool is_solid(const glint_scene *scene, const glint_instance *instance)
{
    return scene->material_count > 0 && glint_instance_is_solid(scene, instance);
}

static bool find_listed(finding *f, bool by_kind, bool closed_alone)
{
    const glint_weld_list list = {f->list, f->count, f->kind_of, by_kind};
    return glint_weld(&f->weld, &list) &&
           glint_components_find(&f->components, &f->weld, closed_alone, f->topology);
}

// Finds the components of each instance, but of solids only the closed ones.
static bool find_by_instance(finding *f, bool solids_alone)
{
    for (size_t i = 0; i < f->scene->instance_count; i++) {
        const glint_instance *instance = &f->scene->instances[i];
        const bool solid = is_solid(f->scene, instance);
        f->count = (uint32_t)instance->triangle_count;
        for (uint32_t t = 0; t < f->count; t++) {
            f->list[t] = (uint32_t)instance->first_triangle + t;
        }
        if ((solid || !solids_alone) && !find_listed(f, false, solid)) {
            return false;
        }
    }
    return true;
}

// Lists the triangles of solids that are in no component so far. Returns false if there are none.
static bool list_rest(finding *f)
{
    f->count = 0;
    f->has_instances = false;
    for (size_t i = 0; i < f->scene->instance_count; i++) {
        const uint32_t before = f->count;
        const glint_instance *instance = &f->scene->instances[i];
        const size_t end = instance->first_triangle + instance->triangle_count;
        for (size_t t = instance->first_triangle; is_solid(f->scene, instance) && t < end; t++) {
            if (f->topology->component_of[t] == NONE) {
                f->list[f->count++] = (uint32_t)t;
            }
        }
        f->has_instances = f->has_instances || (before > 0 && f->count > before);
    }
    return f->count > 0;
}

// Stores the boundaries of the listed triangles. Returns false if memory is short.
static bool store_boundaries(finding *f)
{
    glint_topology *topology = f->topology;
    for (int pass = 0; pass < 2; pass++) {
        size_t count = 0;
        for (uint32_t corner = 0; corner < 3 * f->count; corner++) {
            if (f->weld.twin[corner] == GLINT_UNPAIRED) {
                if (pass > 0) {
                    topology->open_corners[count] =
                        3 * glint_triangle_at(&f->weld, corner) + corner % 3;
                }
                count++;
            }
        }
        if (pass == 0) {
            topology->open_corners = glint_allocate(count, sizeof *topology->open_corners);
            topology->open_corner_count = count;
        }
        if (topology->open_corners == NULL) {
            return false;
        }
    }
    return true;
}

static bool find_kinds(finding *f)
{
    const glint_scene *scene = f->scene;
    f->kind_of = glint_allocate(scene->material_count, sizeof *f->kind_of);
    for (size_t i = 0; f->kind_of != NULL && i < scene->material_count; i++) {
        const bool solid = glint_material_lobes(&scene->materials[i]).solid;
        f->kind_of[i] = (uint32_t)i;
        for (size_t k = 0; solid && k < i && f->kind_of[i] == i; k++) {
            const bool alike =
                f->kind_of[k] == k && glint_material_lobes(&scene->materials[k]).solid &&
                glint_material_media_are_alike(&scene->materials[i], &scene->materials[k]);
            f->kind_of[i] = (uint32_t)(alike ? k : i);
        }
    }
    return f->kind_of != NULL;
}

// Finds components of solids in several instances: first what is closed together, of any materials.
// The rest is open. Its components have one medium each.
static bool find_across_instances(finding *f)
{
    if (!list_rest(f)) {
        return true;
    }
    if (!find_kinds(f) || (f->has_instances && !find_listed(f, false, true))) {
        return false;
    }
    return !list_rest(f) || (find_listed(f, true, false) && store_boundaries(f));
}

// Counts in another material of a component. The highest priority wins, then the first in the file.
static void add_material(const glint_scene *scene, glint_component *component, uint32_t material)
{
    const glint_material *own = &scene->materials[component->material];
    const glint_material *other = &scene->materials[material];
    component->has_materials = true;
    component->has_media = component->has_media || !glint_material_media_are_alike(own, other);
    if (other->priority > own->priority) {
        component->material = material;
    }
}

// Sorts the components by their first triangle, and sets their instances and materials. Returns
// false if memory is short.
static bool sort_components(const glint_scene *scene, glint_topology *topology)
{
    glint_component *sorted = glint_allocate(topology->component_count, sizeof *sorted);
    uint32_t *number_of = glint_allocate(topology->component_count, sizeof *number_of);
    uint32_t count = 0;
    const bool done = sorted != NULL && number_of != NULL;
    for (size_t i = 0; done && i < topology->component_count; i++) {
        number_of[i] = NONE;
    }
    for (size_t i = 0; done && i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        for (size_t t = 0; t < instance->triangle_count; t++) {
            uint32_t *of = &topology->component_of[instance->first_triangle + t];
            if (*of == NONE) {
                continue;
            }
            if (number_of[*of] == NONE) {
                sorted[count] = topology->components[*of];
                sorted[count].instance = (uint32_t)i;
                sorted[count].material = instance->material;
                topology->boundary_edges += sorted[count].boundary_edges;
                number_of[*of] = count++;
            }
            *of = number_of[*of];
            if (sorted[*of].material != instance->material) {
                add_material(scene, &sorted[*of], instance->material);
            }
        }
    }
    if (done) {
        free(topology->components);
        topology->components = sorted;
        topology->capacity = topology->component_count;
    }
    free(number_of);
    if (!done) {
        free(sorted);
    }
    return done;
}

static glint_status find(const glint_scene *scene, bool solids_alone, glint_topology *topology,
                         glint_error *error)
{
    *topology = (glint_topology){0};
    finding f = {.scene = scene, .topology = topology, .weld = {.scene = scene}};
    // Corner numbers have 32 bits.
    const size_t count = scene->triangle_count <= (NONE - 1) / 3 ? scene->triangle_count : 0;
    f.list = glint_allocate_unset(count, sizeof *f.list);
    topology->component_of = glint_allocate_unset(count, sizeof *topology->component_of);
    bool done = count == scene->triangle_count && f.list != NULL && topology->component_of != NULL;
    if (done) {
        memset(topology->component_of, 0xFF, count * sizeof *topology->component_of);
        done = find_by_instance(&f, solids_alone) && find_across_instances(&f) &&
               sort_components(scene, topology);
    }
    glint_welding_free(&f.weld);
    glint_components_free(&f.components);
    free(f.list);
    free(f.kind_of);
    if (!done) {
        glint_topology_free(topology);
        return glint_fail_memory(error, "the topology of the scene");
    }
    return GLINT_OK;
}

glint_status glint_topology_find(const glint_scene *scene, glint_topology *topology,
                                 glint_error *error)
{
    return find(scene, false, topology, error);
}

glint_status glint_topology_find_solids(const glint_scene *scene, glint_topology *topology,
                                        glint_error *error)
{
    return find(scene, true, topology, error);
}

void glint_topology_free(glint_topology *topology)
{
    free(topology->components);
    free(topology->component_of);
    free(topology->open_corners);
    *topology = (glint_topology){0};
}
