// Makes built-in scenes by formula, so that the installed program can measure itself without a
// file.
#ifndef GLINT_SCENE_BUILT_IN_H
#define GLINT_SCENE_BUILT_IN_H

#include "base/status.h"
#include "scene/scene.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The name of built-in scene `index`, such as "mirror", and a summary of a few words. Both are NULL
// past the last scene. The texts are static.
const char *glint_built_in_name(size_t index);
const char *glint_built_in_summary(size_t index);

// Makes the built-in scene `name`, with one camera; the name is also its path. Every surface except
// a floor is closed. Errors: GLINT_BAD_INPUT for an unknown name, GLINT_OUT_OF_MEMORY. On failure
// `scene` is empty.
glint_status glint_built_in_scene(const char *name, glint_scene *scene, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
