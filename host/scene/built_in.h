// Scenes that need no file, so that the installed program can measure by itself: made by formula.
#ifndef GLINT_SCENE_BUILT_IN_H
#define GLINT_SCENE_BUILT_IN_H

#include "base/status.h"
#include "scene/scene.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The name of built-in scene `index`, "mirror", and in a few words what it is; both NULL past the
// last. Static text.
const char *glint_built_in_name(size_t index);
const char *glint_built_in_summary(size_t index);

// Makes the scene of that name, which is its path too, with one camera. Every surface but a floor
// is closed. Errors: GLINT_BAD_INPUT for a name that is none, GLINT_OUT_OF_MEMORY. On
// failure `scene` is left empty.
glint_status glint_built_in_scene(const char *name, glint_scene *scene, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
