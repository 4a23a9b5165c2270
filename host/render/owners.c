// Finds the node and the material of triangles. See owners.h.
#include "render/owners.h"

#include "base/memory.h"

#include <stdlib.h>

glint_status glint_owners_set(glint_owners *owners, const glint_scene *scene, glint_error *error)
{
    glint_owners_free(owners);
    owners->list = glint_allocate(scene->instance_count, sizeof *owners->list);
    if (owners->list == NULL) {
        return glint_fail_memory(error, "the names of what is seen");
    }
    owners->count = scene->instance_count;
    for (size_t i = 0; i < scene->instance_count; i++) {
        const glint_instance *instance = &scene->instances[i];
        owners->list[i] = (glint_owner){.first_triangle = instance->first_triangle,
                                        .node = instance->node_index,
                                        .material = scene->materials[instance->material].index};
    }
    return GLINT_OK;
}

glint_owner glint_owner_of(const glint_owners *owners, int triangle)
{
    size_t low = 0, high = owners->count; // binary search: the owner is the last with
                                          // first_triangle ≤ triangle
    while (low < high && triangle >= 0) {
        const size_t middle = low + (high - low) / 2;
        if (owners->list[middle].first_triangle <= (size_t)triangle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low > 0 ? owners->list[low - 1] : (glint_owner){.node = -1, .material = -1};
}

void glint_owners_free(glint_owners *owners)
{
    free(owners->list);
    *owners = (glint_owners){0};
}
