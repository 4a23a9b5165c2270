// Stores the environment as a tree of cells, for the lobes of rough surfaces. See kernels/layout.h,
// Lobes.
#ifndef GLINT_ENVIRONMENT_CELLS_H
#define GLINT_ENVIRONMENT_CELLS_H

#include "environment/cube.h"

#ifdef __cplusplus
extern "C" {
#endif

// Writes the cells of all levels, GLINT_CELL_VALUES floats each. `edge` is the edge of the finest
// level: GLINT_CELLS_ROOT times a power of two. A cell holds the light of the bilinear map. If the
// map's edge is a multiple of the level's edge, it is a sum of texels, exact except for rounding.
// Returns the map's brightness, (∫ √(R + G + B) dω / 4π)², from cells of a sixty-fourth of a face's
// edge.
float glint_cells_fill(const glint_cube *cube, int edge, float *cells);

#ifdef __cplusplus
}
#endif

#endif
