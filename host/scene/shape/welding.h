// Welds triangles by their corners' positions, and pairs the half-edges of neighbours.
#ifndef GLINT_SCENE_SHAPE_WELDING_H
#define GLINT_SCENE_SHAPE_WELDING_H

#include "base/hash_table.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_UNPAIRED 0xFFFFFFFFu

// A half-edge, stored under the lesser of its two vertices.
typedef struct glint_half_edge {
    uint32_t upper;  // the greater vertex
    uint32_t corner; // start of the half-edge
} glint_half_edge;

// The triangles to weld. Corner 3 i + k is corner k of triangle i of the list.
typedef struct glint_weld_list {
    const uint32_t *triangles; // [count] numbers in the scene, ascending
    uint32_t count;
    const uint32_t *kind_of; // [material]; NULL: all are of one kind
    bool by_kind;            // corners of different kinds are different vertices
} glint_weld_list;

// The welded vertex of a vertex of the scene.
typedef struct glint_known_weld {
    uint32_t call, vertex; // the list that it was found for, and its number there
} glint_known_weld;

// Zero is valid. Arrays are as large as the largest list so far.
typedef struct glint_welding {
    const glint_scene *scene;
    glint_weld_list list;
    uint32_t capacity; // triangles
    uint32_t vertex_count;
    uint32_t call;           // number of the list, from 1
    glint_known_weld *known; // [vertex of the scene]; NULL without indices
    uint32_t *vertex_of;     // [corner]
    uint32_t *corner_of;     // [vertex]: one of the vertex's corners
    uint32_t *twin;          // [corner]: start of the paired half-edge, or GLINT_UNPAIRED
    glint_hash_table table;  // of vertices
    uint32_t *first_edge;    // [vertex + 1]: index into edges
    glint_half_edge *edges;  // [corner]: sorted by the lesser vertex, the greater one, the corner
} glint_welding;

// Welds corners whose positions are equal bit for bit (−0 = 0), and pairs half-edges. Vertices that
// the scene shares are looked at once. Twins run in opposite directions along one edge. Where more
// than two triangles share an edge, each pair bounds one wedge of the inside; triangles of one kind
// are paired first. Returns false if memory is short.
bool glint_weld(glint_welding *weld, const glint_weld_list *list);
void glint_welding_free(glint_welding *weld);

static inline uint32_t glint_next_corner(uint32_t corner)
{
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}

// The number in the scene of a corner's triangle.
static inline uint32_t glint_triangle_at(const glint_welding *weld, uint32_t corner)
{
    return weld->list.triangles[corner / 3];
}

// The position relative to the anchor of the corner's part.
static inline const float *glint_position_at(const glint_welding *weld, uint32_t corner)
{
    return glint_scene_told(weld->scene, glint_triangle_at(weld, corner), corner % 3);
}

#endif
