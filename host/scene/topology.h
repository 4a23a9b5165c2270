// Proves facts about the scene's surfaces: where they are open, and which components are convex.
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

// A set of triangles of one instance that are connected by shared vertex positions (equal bit for
// bit, −0 = 0).
typedef struct glint_component {
    uint32_t instance;
    size_t triangle_count;
    size_t boundary_edges; // edges without exactly two triangles, or with two of one orientation
    bool closed;           // no boundary edges: every edge joins two oppositely oriented triangles
    bool simple;           // closed, with the topology of a sphere (V − E + F = 2)
    // Proved convex: it is simple and wraps once around its inside, no edge bends inwards, and no
    // vertex lies in a hollow. Dents below 16 float roundings of the vertices do not count. False:
    // not proved.
    bool convex;
    float low[3], high[3]; // bounds in stored coordinates
    double volume;         // stored units³, if closed; negative if inside out
} glint_component;

// Zero is valid. Components are in the order of their first triangle.
typedef struct glint_topology {
    size_t component_count;
    glint_component *components;
    size_t boundary_edges;  // sum over the components
    uint32_t *component_of; // [triangle of the scene]; UINT32_MAX: no component
} glint_topology;

// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_topology_find(const glint_scene *scene, glint_topology *topology,
                                 glint_error *error);
// Finds the topology of the solids only.
glint_status glint_topology_find_solids(const glint_scene *scene, glint_topology *topology,
                                        glint_error *error);
void glint_topology_free(glint_topology *topology);

// False if it is proved that no ray can be inside two solids at once. The proof: every component of
// a solid material is convex, and no two of their bounds overlap.
bool glint_topology_solids_may_nest(const glint_scene *scene, const glint_topology *topology);

#ifdef __cplusplus
}
#endif

#endif
