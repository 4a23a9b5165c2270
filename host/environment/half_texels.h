// Stores a cube map's texels as halfs, which halves memory and bandwidth, and measures the error
// that rounding adds.
#ifndef GLINT_ENVIRONMENT_HALF_TEXELS_H
#define GLINT_ENVIRONMENT_HALF_TEXELS_H

#include "base/status.h"
#include "environment/cube.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The error of rounding a map to half. Errors are root mean squares over R, G and B and over the
// sphere, by solid angle.
typedef struct glint_half_rounding {
    // The error over the mean of R, G and B. It corresponds to the relative RMSE of frames. Bright
    // lights decide it, although their own relative error is no larger.
    double relative_rmse;
    // Each error is divided by its own value or by the mean, whichever is larger: this is how it
    // looks beside them. At most 2⁻¹¹ if no denormal halfs matter, and 2e-4 if everything is as
    // bright as the mean.
    double visible_rmse;
    // The largest magnitude of R, G or B of any texel, border included. NaN if a texel is NaN.
    float largest;
} glint_half_rounding;

// Measures the rounding error. A map without texels, or all black, has no error.
glint_status glint_half_rounding_measure(const glint_cube *cube, glint_half_rounding *rounding,
                                         glint_error *error);

// Writes glint_cube_size(cube) halfs in the order of the map's own texels.
void glint_cube_to_half(const glint_cube *cube, uint16_t *texels);

#ifdef __cplusplus
}
#endif

#endif
