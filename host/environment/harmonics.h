// Irradiance by nine spherical harmonics: a quadratic polynomial of the normal.
#ifndef GLINT_ENVIRONMENT_HARMONICS_H
#define GLINT_ENVIRONMENT_HARMONICS_H

#include "base/status.h"
#include "environment/cube.h"
#include "kernels/layout.h"

#ifdef __cplusplus
extern "C" {
#endif

// Sets the coefficients (R, G, B, unused) of E(n)/π, E as in irradiance.h, by what of the
// environment's radiance lies in the bands 0, 1 and 2 (Ramamoorthi and Hanrahan 2001); the
// polynomial stands in kernels/layout.h. Band 3 brings nothing, and what is left out is little: of
// a single distant light 8.8% (root mean square), of wide ones below 1%. The environment is
// taken as its texels, each right to 2e-5. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_irradiance_harmonics(const glint_cube *radiance,
                                        float coefficients[GLINT_HARMONICS][4], glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
