// Reads the chosen animations of a document as curves of nodes.
#ifndef GLINT_SCENE_GLTF_CLIPS_H
#define GLINT_SCENE_GLTF_CLIPS_H

#include "scene/document.h"
#include "scene/gltf/curve.h"
#include "scene/gltf/tally.h"

// The curves of a node's properties. Without keys a property does not move.
typedef struct glint_moves {
    glint_curve of[GLINT_PROPERTIES];
} glint_moves;

// Zero is valid: nothing moves.
typedef struct glint_clips {
    glint_moves *moves; // [count], in no order; they own their curves
    size_t count, capacity;
    int32_t *moves_of; // [node]: 1 + index of its moves; 0: none
    const char *name;  // of the clip, or of the first of several that has one; NULL: none; borrowed
    double duration;   // seconds to the last key
} glint_clips;

// Reads the clip by name or index, or "all" or "none"; NULL: the first, if any. Leaves out curves
// whose keys cannot be used, and tallies them. Errors: GLINT_BAD_INPUT, GLINT_OUT_OF_MEMORY.
glint_status glint_clips_read(const glint_document *document, const char *name, glint_clips *clips,
                              glint_tally *tally, glint_error *error);

// Returns the curve of a node's property; NULL: it does not move.
const glint_curve *glint_clips_curve(const glint_clips *clips, int node, glint_property property);

void glint_clips_free(glint_clips *clips);

#endif
