// Proves facts about the scene's surfaces: where they are open, and which components are convex.
#ifndef GLINT_SCENE_SHAPE_TOPOLOGY_H
#define GLINT_SCENE_SHAPE_TOPOLOGY_H

#include "base/status.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A body: a set of triangles that are closed together, or an open surface. Triangles are connected
// by shared edges, open ones also by shared vertices (positions equal bit for bit, −0 = 0). The
// triangles of a solid may be of several instances, however the file cuts it. Others are of one.
typedef struct glint_component {
    uint32_t instance;  // the first one
    uint32_t material;  // of the inside; of several, the highest priority wins, then the first
    bool has_materials; // it has several materials
    bool has_media;     // light does not travel alike in them
    size_t triangle_count;
    size_t boundary_edges; // edges with a triangle that no oppositely oriented one continues
    bool closed;           // no boundary edges
    bool simple;           // closed, with the topology of a sphere (V − E + F = 2)
    // Proved convex: it is simple and wraps once around its inside, no edge bends inwards, and no
    // vertex lies in a hollow. Dents below 16 float roundings of the vertices do not count. False:
    // not proved.
    bool convex;
    float low[3], high[3]; // bounds in stored coordinates
    // Stored units³; negative if inside out. An open component counts as closed through the middle
    // of its boundary.
    double volume;
    double volume_error; // bounds what rounding of the vertices changes in it
} glint_component;

// Zero is valid. Components are in the order of their first triangle.
typedef struct glint_topology {
    size_t component_count, capacity;
    glint_component *components;
    size_t boundary_edges;  // sum over the components
    uint32_t *component_of; // [triangle of the scene]; UINT32_MAX: no component
    // The boundaries of open solids: the corners where their edges start, 3 × triangle + corner.
    size_t open_corner_count;
    uint32_t *open_corners;
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
