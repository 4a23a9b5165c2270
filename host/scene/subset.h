// A scene without some of its nodes.
#ifndef GLINT_SCENE_SUBSET_H
#define GLINT_SCENE_SUBSET_H

#include "base/status.h"
#include "scene/scene.h"

// Takes the triangles of a node away: of all instances that bear its name, else of the node with
// that index. *low and *high (may be NULL) become their bounds (metres, world space); the scene's
// own bounds become those of what is left, its origin and unit stay. Errors: GLINT_BAD_INPUT,
// naming the nodes that there are; GLINT_DEVICE_FAILED (memory). The scene is then unchanged.
glint_status glint_scene_remove_node(glint_scene *scene, const char *node, glint_vec3 *low,
                                     glint_vec3 *high, glint_error *error);

#endif
