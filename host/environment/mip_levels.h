// Computes a cube map's coarser levels, for look-ups through wide cones.
#ifndef GLINT_ENVIRONMENT_MIP_LEVELS_H
#define GLINT_ENVIRONMENT_MIP_LEVELS_H

#include "environment/cube.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// The levels of a map are the map itself and coarser maps. The edge of each is half of the edge
// before, rounded down, until it is 1. They stand one after the other in memory, each with its
// border.

// The number of values in all levels, including the map; 0 for edge 0.
size_t glint_mip_levels_size(int edge);

// Writes the levels after the first: glint_mip_levels_size(cube->edge) − glint_cube_size(cube)
// floats. Texels are means of the finer level's texels by solid angle, so each level sends the same
// light as the map. This is exact to a rounding if edges are even, and nearly exact if an edge is
// odd.
void glint_mip_levels_fill(const glint_cube *cube, float *coarser);

// Writes all levels as glint_mip_levels_size(cube->edge) halfs, from the map and the output of
// glint_mip_levels_fill. Borders are extrapolated. If a border exceeds the largest half, it becomes
// the largest half, in `coarser` too.
void glint_mip_levels_to_half(const glint_cube *cube, float *coarser, uint16_t *texels);

#ifdef __cplusplus
}
#endif

#endif
