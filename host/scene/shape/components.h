// Divides welded triangles into components, and measures these; only topology.c uses it.
#ifndef GLINT_SCENE_SHAPE_COMPONENTS_H
#define GLINT_SCENE_SHAPE_COMPONENTS_H

#include "scene/shape/topology.h"
#include "scene/shape/welding.h"

// The components of a welding. Zero is valid. Arrays are as large as the largest welding so far.
typedef struct glint_components {
    const glint_welding *weld;
    size_t count;
    glint_component *of; // [count], in the topology
    uint32_t capacity;   // triangles
    uint32_t *parent;    // [triangle of the list]: union-find
    uint32_t *number_of; // [triangle of the list]: its component, or UINT32_MAX
    uint32_t *triangles; // triangles of the list, sorted by component
    uint32_t *first;     // [count + 1]: index into triangles
    uint32_t *vertices;  // [count]: number of vertices
    uint32_t *stamp;     // [vertex]: for any use
    uint32_t *place;     // [vertex]: for any use
    bool *is_open;       // [triangle of the list]
    bool *is_crowded;    // [count]: more than two triangles of the component share an edge
} glint_components;

// Finds the components of a welding, and appends them to the topology. `closed_alone`: finds closed
// ones only; `component_of` of other triangles stays as it is. Returns false if memory is short.
bool glint_components_find(glint_components *all, const glint_welding *weld, bool closed_alone,
                           glint_topology *topology);
void glint_components_free(glint_components *all);

// Proves which components are convex, and sets `simple` and `convex`. (convex_components.c)
void glint_components_judge(glint_components *all);

#endif
