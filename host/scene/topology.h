// What can be proved of the scene's surfaces: where they are open, and which parts are convex.
#ifndef GLINT_SCENE_TOPOLOGY_H
#define GLINT_SCENE_TOPOLOGY_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A set of triangles joined by shared vertex positions (equal bit for bit, −0 = 0) within one
// instance.
typedef struct glint_component {
    uint32_t instance;
    size_t triangle_count;
    size_t boundary_edges; // edges with other than two triangles, or two of one orientation
    bool closed;           // no boundary edges: every edge joins two triangles, oppositely oriented
    bool simple;           // closed, of sphere topology (V − E + F = 2)
    bool convex;           // proved: simple, wrapped once around
                           // its inside, no edge bends inwards and no vertex lies in a hollow, but
                           // for dents below 16 float roundings of the vertices; false: not proved
    float low[3], high[3]; // bounds in stored coordinates
    double volume;         // stored units³, where it is closed; less than 0 where it is inside out
} glint_component;

// Zero is valid. Components are in the order of their first triangle.
typedef struct glint_topology {
    size_t component_count;
    glint_component *components;
    size_t boundary_edges;  // sum over the components
    uint32_t *component_of; // [triangle of the scene]; UINT32_MAX: of none
} glint_topology;

// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_topology_find(const glint_scene *scene, glint_topology *topology,
                                 glint_error *error);
// Of the solids alone.
glint_status glint_topology_find_solids(const glint_scene *scene, glint_topology *topology,
                                        glint_error *error);
void glint_topology_free(glint_topology *topology);

// True unless it is proved that no ray can be inside two solids at once: every component of a solid
// material is convex, and no two of their bounds overlap.
bool glint_topology_solids_may_nest(const glint_scene *scene, const glint_topology *topology);

#ifdef __cplusplus
}
#endif

#endif
