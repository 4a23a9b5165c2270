// Small parts of a scene, with origins of their own. A float stores a place to 24 bits of its
// distance from the origin. For a bead on a wide floor this leaves few bits. So each small part has
// an anchor, and its corners are stored relative to the anchor.
#ifndef GLINT_SCENE_SHAPE_PARTS_H
#define GLINT_SCENE_SHAPE_PARTS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Zero is valid: there are no parts, and the scene's positions are exact.
typedef struct glint_parts {
    size_t count;        // number of anchors
    float (*anchors)[3]; // [count], stored coordinates; owned. The first is (0, 0, 0)
    uint32_t *part_of;   // [triangle]; owned
    float *positions;    // [vertex of the scene][3], relative to the part's anchor; owned
} glint_parts;

// Sets `told` to a place relative to the anchor of a part. Without parts there is only part 0.
static inline void glint_parts_tell(const glint_parts *parts, uint32_t part, const double place[3],
                                    float told[3])
{
    for (int k = 0; k < 3; k++) {
        told[k] = (float)(parts->count > 0 ? place[k] - (double)parts->anchors[part][k] : place[k]);
    }
}

// Sets `position` to the rounded place that `told` tells.
static inline void glint_parts_round(const glint_parts *parts, uint32_t part, const float told[3],
                                     float position[3])
{
    for (int k = 0; k < 3; k++) {
        position[k] = parts->count > 0 ? parts->anchors[part][k] + told[k] : told[k];
    }
}

// True if a scene may have small parts, by the width of its smallest triangle in stored units.
bool glint_parts_may_be_there(double smallest_triangle);

// Triangles with all digits; borrowed.
typedef struct glint_exact_triangles {
    const double *places;    // [vertex_count][3], stored coordinates
    size_t vertex_count;     // vertices of different numbers may be at one place
    const uint32_t *corners; // [count][3], the corners' vertices; NULL: corner i is vertex i
    size_t count;
} glint_exact_triangles;

// Finds the anchors of parts, and the part of each triangle; leaves `positions` NULL. Triangles
// that share edges form one part, also if only floats make their edges equal. All triangles of a
// part use one anchor, so that no ray passes between them (watertight). On failure, and if no part
// is small, *parts is zero. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_parts_find(const glint_exact_triangles *exact, glint_parts *parts,
                              glint_error *error);

void glint_parts_free(glint_parts *parts);

#ifdef __cplusplus
}
#endif

#endif
