// Computes irradiance from nine spherical harmonics: a quadratic polynomial of the normal.
#ifndef GLINT_ENVIRONMENT_HARMONICS_H
#define GLINT_ENVIRONMENT_HARMONICS_H

#include "base/status.h"
#include "environment/cube.h"
#include "kernels/layout.h"

#ifdef __cplusplus
extern "C" {
#endif

// Sets the coefficients (R, G, B, unused) of E(n)/π; E is as in irradiance.h. They are the bands 0,
// 1 and 2 of the environment's radiance (Ramamoorthi and Hanrahan 2001). kernels/layout.h has the
// polynomial. Band 3 adds nothing. The error is small: 8.8% (root mean square) under a single
// distant light, below 1% under wide lights. The environment is its texels, each right to 2e-5.
// Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_irradiance_harmonics(const glint_cube *radiance,
                                        float coefficients[GLINT_HARMONICS][4], glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
