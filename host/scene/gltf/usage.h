// Lists the glTF features that a file uses, and how glint treats each: `glint info` prints the
// table.
#ifndef GLINT_SCENE_GLTF_USAGE_H
#define GLINT_SCENE_GLTF_USAGE_H

#include "scene/gltf/load.h"

// Sets the scene's usages. Call it after its materials are set. Fails with GLINT_OUT_OF_MEMORY.
glint_status glint_usages_list(const glint_load *load, glint_scene *scene, glint_error *error);

#endif
