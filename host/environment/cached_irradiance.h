// Keeps irradiance maps in the cache of environments (cache.h).
#ifndef GLINT_ENVIRONMENT_CACHED_IRRADIANCE_H
#define GLINT_ENVIRONMENT_CACHED_IRRADIANCE_H

#include "base/status.h"
#include "environment/cube.h"

#ifdef __cplusplus
extern "C" {
#endif

// Does the same as glint_irradiance_map, but takes the map from the cache if it is there. Keeps
// only the maps of environments up to GLINT_CACHED_IRRADIANCE_EDGE: for a larger one, hashing its
// texels takes as long as computing the map.
#define GLINT_CACHED_IRRADIANCE_EDGE 1024
glint_status glint_irradiance_map_cached(const glint_cube *radiance, int edge,
                                         glint_cube *irradiance, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
