// The glTF loader's door: plain C, behind it C++ (nlohmann::json to check, tinygltf to load).
#ifndef GLINT_SCENE_GLTF_H
#define GLINT_SCENE_GLTF_H

#include "base/status.h"
#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// What glint_scene_load promises, for a `scene` that is zero. On failure its members may be partly
// filled; the caller frees them.
glint_status glint_gltf_load(const char *path, const glint_scene_options *options,
                             glint_scene *scene, glint_warnings *warnings, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
