// Walks the chosen nodes at one time: finds their places, their primitives, cameras and lights.
#ifndef GLINT_SCENE_GLTF_WALK_H
#define GLINT_SCENE_GLTF_WALK_H

#include "scene/gltf/load.h"

// The places of a node's instances, relative to the node.
typedef struct glint_instances {
    glint_mat4 *places; // [count]; owned
    size_t count;       // 0: it is not instanced
} glint_instances;

// Finds the instances of a node, which must have a mesh; `drawn` primitives are already drawn.
// Errors: GLINT_BAD_INPUT if there are too many; GLINT_OUT_OF_MEMORY.
glint_status glint_instances_find(const glint_load *load, int node, size_t drawn,
                                  glint_instances *instances, glint_error *error);

// Finds which meshes, cameras and lights the clip moves.
glint_status glint_walk_survey(glint_load *load, glint_error *error);

// Fills load->draws, scene->cameras, scene->lights and the skipped counts, for `time`.
glint_status glint_walk(glint_load *load, double time, glint_scene *scene, glint_error *error);

#endif
