// Finds the root nodes that a scene shows.
#ifndef GLINT_SCENE_GLTF_ROOTS_H
#define GLINT_SCENE_GLTF_ROOTS_H

#include "scene/document.h"
#include "scene/gltf/tally.h"

// Roots, each once.
typedef struct glint_roots {
    int32_t *nodes; // [count]; owned
    size_t count;
} glint_roots;

// Finds the roots of a scene. `name` is a scene's name or index; NULL: the file's default. Warns of
// nodes that no scene should list. The caller frees roots->nodes, also after an error. Errors:
// GLINT_BAD_INPUT, GLINT_OUT_OF_MEMORY.
glint_status glint_roots_find(const glint_document *document, const char *name, glint_roots *roots,
                              glint_tally *tally, glint_error *error);

#endif
