// Removes some of a scene's nodes, or all others.
#ifndef GLINT_SCENE_SUBSET_H
#define GLINT_SCENE_SUBSET_H

#include "base/status.h"
#include "scene/scene.h"

// `nodes` is a list with commas between its entries. An entry is a name, which means all nodes with
// this name. If no node has the name, the entry is a node's index. A node includes all nodes below
// it. In a scene that moves, a node may have no triangles at a time; then there is nothing to
// remove or keep. The scene's bounds shrink to the remaining triangles; its origin, unit and
// cameras stay. Errors, with the scene unchanged: GLINT_BAD_INPUT, listing the nodes of the scene;
// GLINT_OUT_OF_MEMORY.

// Removes the triangles of the nodes.
glint_status glint_scene_remove_nodes(glint_scene *scene, const char *nodes, glint_error *error);

// Removes the triangles of all other nodes.
glint_status glint_scene_keep_nodes(glint_scene *scene, const char *nodes, glint_error *error);

// Computes the middle of the nodes' bounds (metres, world space); the scene does not change.
// GLINT_BAD_INPUT also if the nodes have no triangles at this time.
glint_status glint_scene_middle_of_nodes(const glint_scene *scene, const char *nodes,
                                         glint_vec3 *middle, glint_error *error);

#endif
