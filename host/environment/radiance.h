// Values in environment files that are no radiance.
//
// Before anything filters them:
//   NaN and negative values, −∞ too, become 0;
//   +∞ becomes the largest finite value of the files (65504 where there is none above 0): it marks
//   what the format could not hold, the sun mostly, and is at least as bright as the brightest.
// Finite values stay, however large. Texels so mended are counted, and one warning says how many.
#ifndef GLINT_ENVIRONMENT_RADIANCE_H
#define GLINT_ENVIRONMENT_RADIANCE_H

#include "base/status.h"
#include "environment/cube.h"
#include "image/image.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Mends the picture, with a warning that names `path`. Returns how many texels it was.
size_t glint_radiance_mend(const char *path, glint_image *image, glint_warnings *warnings);

// The same of a cube; its border is filled anew.
size_t glint_cube_mend(const char *name, glint_cube *cube, glint_warnings *warnings);

#ifdef __cplusplus
}
#endif

#endif
