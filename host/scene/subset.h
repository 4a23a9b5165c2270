// A scene without some of its nodes.
#ifndef GLINT_SCENE_SUBSET_H
#define GLINT_SCENE_SUBSET_H

#include "base/status.h"
#include "scene/scene.h"

// `nodes` is a list with commas between: each a node's name, which stands for all nodes that bear
// it, or, where none does, a node's index; what hangs under a node belongs to it. In a scene that
// moves a node may have nothing to show at a time: then it is nothing that is taken away, or kept.
// The scene's bounds become those of what is left, its origin and unit stay, and so do its cameras.
// Errors, with the scene unchanged: GLINT_BAD_INPUT, naming the nodes that there are;
// GLINT_OUT_OF_MEMORY.

// Takes the triangles of the nodes away.
glint_status glint_scene_remove_nodes(glint_scene *scene, const char *nodes, glint_error *error);

// Takes all others away.
glint_status glint_scene_keep_nodes(glint_scene *scene, const char *nodes, glint_error *error);

// The middle of their bounds (metres, world space); nothing is taken away. GLINT_BAD_INPUT also
// where they have nothing to show at this time.
glint_status glint_scene_middle_of_nodes(const glint_scene *scene, const char *nodes,
                                         glint_vec3 *middle, glint_error *error);

#endif
