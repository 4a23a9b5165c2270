// Parts that are small beside the scene. A float tells a place to 24 bits of its distance from the
// origin: of a bead on a wide floor it leaves little. Such a part has an origin of its own, its
// anchor, from which its corners are told.
#ifndef GLINT_SCENE_PARTS_H
#define GLINT_SCENE_PARTS_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Zero is valid: there are none. Then the scene's positions tell all that there is to tell.
typedef struct glint_parts {
    size_t count;        // of anchors
    float (*anchors)[3]; // [count], stored coordinates; owned. The first is (0, 0, 0)
    uint32_t *part_of;   // [triangle]; owned
    float *positions;    // [triangle][3 corners][3]: from the part's anchor; owned
} glint_parts;

// Whether a scene may have small parts whose smallest triangle is so far across, in stored units.
bool glint_parts_may_be_there(double smallest_triangle);

// Finds the parts of triangles, `exact` [count][3 corners][3] in stored coordinates. What shares
// edges, also edges that floats cannot tell apart, is one part: its triangles are told from one
// origin, so that no ray passes between them. On failure, and where no part is small, *parts is
// zero. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_parts_find(const double *exact, size_t count, glint_parts *parts,
                              glint_error *error);

void glint_parts_free(glint_parts *parts);

#ifdef __cplusplus
}
#endif

#endif
