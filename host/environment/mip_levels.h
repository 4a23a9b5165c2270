// A cube map's coarser levels: what is seen of it through wider and wider cones.
#ifndef GLINT_ENVIRONMENT_MIP_LEVELS_H
#define GLINT_ENVIRONMENT_MIP_LEVELS_H

#include "environment/cube.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// A map's levels are itself and ever coarser ones: each has half of the last one's edge, rounded
// down, to the edge 1. They stand one after the other, each with its border.

// The number of values in all levels, the map's own included; 0 for the edge 0.
size_t glint_mip_levels_size(int edge);

// Writes the levels after the first: glint_mip_levels_size(cube->edge) − glint_cube_size(cube)
// floats. Texels are means of those of the last level by solid angle, so that each level sends the
// same light as the map: to a rounding where edges are even, nearly where one is odd.
void glint_mip_levels_fill(const glint_cube *cube, float *coarser);

// Writes all levels as glint_mip_levels_size(cube->edge) halfs, from the map and what
// glint_mip_levels_fill wrote. Where a border, which is extrapolated, is more than half holds, it
// becomes the most that half holds, in `coarser` too.
void glint_mip_levels_to_half(const glint_cube *cube, float *coarser, uint16_t *texels);

#ifdef __cplusplus
}
#endif

#endif
