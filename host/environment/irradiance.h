// Irradiance: what a matte surface receives from the whole environment.
#ifndef GLINT_ENVIRONMENT_IRRADIANCE_H
#define GLINT_ENVIRONMENT_IRRADIANCE_H

#include "base/status.h"
#include "environment/cube.h"

#ifdef __cplusplus
extern "C" {
#endif

// Texels along an edge of the map that frames use, each of which is exact. Between them bilinear
// filtering is off by about 10⁻⁴ under an environment of lights wider than a few degrees; under a
// point-like one the irradiance has a kink where the light sets, and there it is off by up to half
// a texel's angle over 2, 0.8% of that light's full irradiance.
#define GLINT_IRRADIANCE_EDGE 64

// Fills `irradiance` (edge texels a face) with E(n)/π, where
// E(n) = ∫ L(ω) max(0, n·ω) dω over the sphere: 1 under a uniform environment of radiance 1.
// The environment is taken as its texels, each with its first moment (to 7e-9); only blocks of
// texels that n's horizon runs through are approximated (4e-6, see irradiance.c). The
// border holds E(n)/π at its own place in the plane of the face: a smooth function is interpolated
// better so than through values on the edges, as a radiance map is (see cube.c).
glint_status glint_irradiance_map(const glint_cube *radiance, int edge, glint_cube *irradiance,
                                  glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
