// Turns cameras into parts of file names.
#ifndef GLINT_CLI_RENDER_CAMERA_NAMES_H
#define GLINT_CLI_RENDER_CAMERA_NAMES_H

#include "base/status.h"
#include "scene/camera.h"

#include <stddef.h>

// Sets names[count] to one file name part for each camera, malloc'd. The parts differ even on file
// systems that ignore case. A camera without its own name gets its index. Errors:
// GLINT_OUT_OF_MEMORY; the finished names are then set.
glint_status render_camera_names(const glint_camera *cameras, size_t count, char **names,
                                 glint_error *error);

// Inserts a camera's name into the path: before the place of the frame number or, without one,
// before the extension. malloc'd; NULL without memory.
char *render_camera_path(const char *path, const char *name);

#endif
