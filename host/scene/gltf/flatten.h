// Flattens the scene: transforms every drawn triangle to world space, in double, and stores it.
#ifndef GLINT_SCENE_GLTF_FLATTEN_H
#define GLINT_SCENE_GLTF_FLATTEN_H

#include "scene/gltf/load.h"

// Fails with GLINT_BAD_INPUT if a scene may not have so many triangles.
glint_status glint_flatten_check_count(size_t triangles, glint_error *error);

// Computes the shapes of a walk's draws, and stores their triangles. The scene's materials are
// numbered as in load->materials. Then drops draws and shapes. Errors: GLINT_BAD_INPUT,
// GLINT_OUT_OF_MEMORY.
glint_status glint_flatten(glint_load *load, glint_scene *scene, glint_error *error);

#endif
