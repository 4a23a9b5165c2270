// A cube map's texels as halfs, which take half of the memory and of its time, and the error that
// this adds.
#ifndef GLINT_ENVIRONMENT_HALF_TEXELS_H
#define GLINT_ENVIRONMENT_HALF_TEXELS_H

#include "base/status.h"
#include "environment/cube.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// What rounding to half does to a map. Errors are root mean squares over R, G and B and over the
// sphere, by solid angle.
typedef struct glint_half_rounding {
    // Over the mean of R, G and B: what a relative RMSE means of frames too. Bright lights decide
    // it, although they err by no more of themselves than anything else.
    double relative_rmse;
    // Each error taken of its own value or of the mean, whichever is larger, as it is seen beside
    // them: at most 2⁻¹¹ where no denormal halfs matter, and 2e-4 where all is as bright as the
    // mean.
    double visible_rmse;
    float largest; // magnitude of R, G or B of any texel, the border's too; NaN if one is
} glint_half_rounding;

// A map without texels, or all black, has no error.
glint_status glint_half_rounding_measure(const glint_cube *cube, glint_half_rounding *rounding,
                                         glint_error *error);

// Writes glint_cube_size(cube) halfs in the order of the map's own texels.
void glint_cube_to_half(const glint_cube *cube, uint16_t *texels);

#ifdef __cplusplus
}
#endif

#endif
