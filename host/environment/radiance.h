// Replaces values in environment files that are no radiance, before any filtering:
//   NaN and negative values, also −∞, become 0;
//   +∞ becomes the largest finite value of the files, or 65504 if no value is above 0. It marks a
//   value that the format could not hold, mostly the sun: at least as bright as the brightest.
// Finite values stay, however large. One warning says how many texels were replaced.
#ifndef GLINT_ENVIRONMENT_RADIANCE_H
#define GLINT_ENVIRONMENT_RADIANCE_H

#include "base/status.h"
#include "environment/cube.h"
#include "image/image.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Replaces such values in the picture and warns with the name `path`. Returns the number of texels.
size_t glint_radiance_mend(const char *path, glint_image *image, glint_warnings *warnings);

// Does the same with a cube, and fills its border again.
size_t glint_cube_mend(const char *name, glint_cube *cube, glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
