// Stores radiance by direction as a cube map.
#ifndef GLINT_ENVIRONMENT_CUBE_H
#define GLINT_ENVIRONMENT_CUBE_H

#include "base/status.h"
#include "base/vector.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// A cube map in the layout of kernels/layout.h: linear Rec.709 radiance, texel centres at
// (i + ½)/edge. Each face has a border of one texel, made from its neighbours. So bilinear
// filtering is continuous over edges and corners, and right there to second order in 1/edge. Zero
// is valid: no texels.
typedef struct glint_cube {
    int edge;      // texels along a face's edge, without the border
    float *texels; // [6][edge + 2][edge + 2][4], owned
    // The texels are mapped from a file, this many bytes behind its beginning (cache.h). 0: they
    // are allocated.
    size_t mapped_from;
} glint_cube;

// Far above every useful size, and below an int's overflow: (edge + 2)² × 6 × 4 < 2³¹.
#define GLINT_CUBE_EDGE_MAX 9000

// Makes a cube of zeros with this edge. Errors: GLINT_OUT_OF_MEMORY, also above
// GLINT_CUBE_EDGE_MAX.
glint_status glint_cube_create(int edge, glint_cube *cube, glint_error *error);
// Does the same without setting the texels, for a caller that sets them all.
glint_status glint_cube_create_unset(int edge, glint_cube *cube, glint_error *error);
void glint_cube_free(glint_cube *cube);

// The number of floats in `texels`.
size_t glint_cube_size(const glint_cube *cube);

// The texel of `face` at column i and row j, each in [−1, edge].
float *glint_cube_texel(const glint_cube *cube, int face, int i, int j);

// Sets the texel of `face` at column i and row j.
void glint_cube_store(const glint_cube *cube, int face, int i, int j, const double rgb[3]);

// Fills the border from the neighbours' texels. Call it when the inside is complete.
void glint_cube_fill_border(glint_cube *cube);

// The direction (not normalised) of the point (s, t) on a face, see kernels/layout.h.
glint_vec3 glint_cube_direction(int face, double s, double t);

// Returns the face that a direction meets, and its point (s, t). If the largest components are
// equal, the order x, y, z decides, as in ImfEnvmap.h and cubemap.cl.
int glint_cube_place(glint_vec3 direction, double *s, double *t);

// Mirrors the cube along the axes named in `flip` ("x" exchanges left and right, "xz" is half a
// turn). It only moves texels. Fails with GLINT_OUT_OF_MEMORY and then leaves the cube unchanged.
glint_status glint_cube_mirror(glint_cube *cube, const char *flip, glint_error *error);

// Looks up a direction of any length but zero, bilinearly.
void glint_cube_sample(const glint_cube *cube, glint_vec3 direction, double rgb[3]);

#ifdef __cplusplus
}
#endif

#endif
