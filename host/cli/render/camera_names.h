// What a camera is called in the names of files.
#ifndef GLINT_CLI_RENDER_CAMERA_NAMES_H
#define GLINT_CLI_RENDER_CAMERA_NAMES_H

#include "base/status.h"
#include "scene/camera.h"

#include <stddef.h>

// The part of a file's name that stands for each of `count` cameras, into names[count], malloc'd.
// They are different whatever the file system does with capitals. A camera without a name of its
// own is called by its index. Errors: GLINT_OUT_OF_MEMORY; the names so far are then set.
glint_status render_camera_names(const glint_camera *cameras, size_t count, char **names,
                                 glint_error *error);

// The path with a camera's name before the frame number's place or, without one, before the
// extension. malloc'd; NULL without memory.
char *render_camera_path(const char *path, const char *name);

#endif
