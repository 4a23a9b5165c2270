// Chooses the nodes that a scene shows, and places them.
#ifndef GLINT_SCENE_GLTF_NODES_H
#define GLINT_SCENE_GLTF_NODES_H

#include "base/vector.h"
#include "scene/gltf/clips.h"

// A node of the chosen scene, or a node of a tree that only joints of its skins need.
typedef struct glint_visit {
    int node;
    ptrdiff_t parent; // index of the parent's visit; −1: a root
    bool is_shown;    // false: hidden, or only joints need the node
    bool moves;       // over time, by itself or with an ancestor
    bool deforms;     // over time: its mesh is morphed, or its skin's joints move
} glint_visit;

// Zero is valid: no nodes.
typedef struct glint_visits {
    const glint_document *document; // borrowed, as are the clips
    const glint_clips *clips;
    glint_visit *all; // [count], depth first: parents stand before their children; owned
    size_t count;
    ptrdiff_t *of; // [node]: its visit; −1: none; owned
} glint_visits;

// Chooses the nodes of a scene, by name or index; NULL: of the file's default scene. The caller has
// set the document and the clips. Does not set `deforms`. Errors: GLINT_BAD_INPUT,
// GLINT_OUT_OF_MEMORY.
glint_status glint_visits_choose(glint_visits *visits, const char *name, glint_tally *tally,
                                 glint_error *error);

void glint_visits_free(glint_visits *visits);

// Makes a matrix of parts. `rotation` is (x, y, z, w) of any length but 0: exporters round, and a
// longer quaternion means the same rotation.
glint_mat4 glint_matrix_of_parts(const double translation[3], const double rotation[4],
                                 const double scale[3]);

// Returns the matrix of a visit at `time` (seconds). `placed` holds the matrices of the visits
// before it.
glint_mat4 glint_visit_place(const glint_visits *visits, size_t visit, double time,
                             const glint_mat4 *placed);

#endif
