// Places punctual lights.
#ifndef GLINT_SCENE_GLTF_LIGHTS_H
#define GLINT_SCENE_GLTF_LIGHTS_H

#include "scene/gltf/load.h"

// Adds the light of a visited node to the scene, which has room for it. Leaves out, with a warning,
// a light that shines nowhere or cannot be shown. Fails with GLINT_OUT_OF_MEMORY.
glint_status glint_light_add(glint_load *load, size_t visit, glint_scene *scene,
                             glint_error *error);

#endif
