// Prepares a document's primitives for drawing: opens their arrays and checks their indices. This
// happens once, for any number of nodes that draw them.
#ifndef GLINT_SCENE_GLTF_PRIMITIVES_H
#define GLINT_SCENE_GLTF_PRIMITIVES_H

#include "scene/gltf/primitive.h"

// Zero is valid: none.
typedef struct glint_primitives {
    glint_primitive *all; // in the order of the document; owned, as are the next two
    glint_morph_target *targets;
    glint_influences *influences;
} glint_primitives;

// Gives the primitives the materials of a variant; −1: of none. Borrows the document. Errors:
// GLINT_BAD_INPUT for an index without a vertex; GLINT_OUT_OF_MEMORY.
glint_status glint_primitives_open(const glint_document *document, int variant,
                                   glint_primitives *primitives, glint_error *error);

void glint_primitives_free(glint_primitives *primitives);

#endif
