// Irradiance: what a matte surface receives from the whole environment.
#ifndef GLINT_ENVIRONMENT_IRRADIANCE_H
#define GLINT_ENVIRONMENT_IRRADIANCE_H

#include "base/status.h"
#include "environment/environment.h"

#ifdef __cplusplus
extern "C" {
#endif

// Fills `irradiance` (edge texels a face, border included) with E(n)/π, where
// E(n) = ∫ L(ω) max(0, n·ω) dω over the sphere: 1 under a uniform environment of radiance 1.
// Exact for the environment as a set of texels, each with its exact solid angle; blocks of texels
// wholly on one side of n's horizon are taken together by their first moment, which is exact too.
glint_status glint_irradiance_map(const glint_cube *radiance, int edge, glint_cube *irradiance,
                                  glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
