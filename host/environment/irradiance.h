// Computes irradiance: the light that a matte surface receives from the whole environment.
#ifndef GLINT_ENVIRONMENT_IRRADIANCE_H
#define GLINT_ENVIRONMENT_IRRADIANCE_H

#include "base/status.h"
#include "environment/cube.h"

#ifdef __cplusplus
extern "C" {
#endif

// The edge in texels of the map that frames use. Each texel is exact. Under lights wider than a few
// degrees, bilinear filtering between texels errs by about 10⁻⁴. Under a point-like light,
// irradiance has a kink where the light sets. There the error is up to half a texel's angle over 2:
// 0.8% of the light's full irradiance.
#define GLINT_IRRADIANCE_EDGE 64

// Fills `irradiance` (edge texels a face) with E(n)/π, where
// E(n) = ∫ L(ω) max(0, n·ω) dω over the sphere: 1 under a uniform environment of radiance 1.
// The environment is its texels, each with its first moment (to 7e-9). Only blocks of texels that
// n's horizon crosses are approximated (4e-6, see irradiance.c). The border holds E(n)/π at its own
// place in the plane of the face. For a smooth function this interpolates better than the border of
// a radiance map, which goes through values on the edges (see cube.c).
glint_status glint_irradiance_map(const glint_cube *radiance, int edge, glint_cube *irradiance,
                                  glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
