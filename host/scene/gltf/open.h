// Opens scenes.
#ifndef GLINT_SCENE_GLTF_OPEN_H
#define GLINT_SCENE_GLTF_OPEN_H

#include "scene/scene.h"

// Does what glint_scene_open does with the document in a memory file, which the caller keeps.
// `path` is the scene's file, beside which its images lie.
glint_status glint_scene_open_document(const char *path, int file,
                                       const glint_scene_options *options,
                                       glint_scene_source **source, glint_error *error);

#endif
