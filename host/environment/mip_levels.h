// A cube map's coarser levels: what is seen of it through wider and wider cones.
#ifndef GLINT_ENVIRONMENT_MIP_LEVELS_H
#define GLINT_ENVIRONMENT_MIP_LEVELS_H

#include "environment/environment.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// How many levels a map of this edge has, itself included: each has half of the last one's edge,
// rounded down, to the edge 1. 0 without texels.
int glint_mip_level_count(int edge);

// The number of floats in all levels, one after the other, each with its border.
size_t glint_mip_levels_size(int edge);

// Writes all levels to `texels`, glint_mip_levels_size(cube->edge) floats: first the map's own
// texels, then level by level the means of those of the last by solid angle, so that each level
// sends the same light as the map: to a rounding where edges are even, nearly where one is odd.
void glint_mip_levels_fill(const glint_cube *cube, float *texels);

// The same as halfs, from such floats.
void glint_mip_levels_to_half(int edge, float *levels, uint16_t *texels);

#ifdef __cplusplus
}
#endif

#endif
