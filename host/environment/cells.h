// The environment as a tree of cells, for the lobes of rough surfaces: see kernels/layout.h, Lobes.
#ifndef GLINT_ENVIRONMENT_CELLS_H
#define GLINT_ENVIRONMENT_CELLS_H

#include "environment/cube.h"

#ifdef __cplusplus
extern "C" {
#endif

// Writes the cells of all levels down to that of the given edge, GLINT_CELLS_ROOT times a power of
// two: GLINT_CELL_VALUES floats each. A cell holds the light of the map, taken bilinearly; sums of
// texels, and so exact but for rounding, where the map's edge is a multiple of the cells'. The
// result is the map's brightness, (∫ √(R + G + B) dω / 4π)², of cells of a sixty-fourth of a face's
// edge.
float glint_cells_fill(const glint_cube *cube, int edge, float *cells);

#ifdef __cplusplus
}
#endif

#endif
