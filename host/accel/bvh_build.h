// Builds and refits the bounding volume hierarchy.
#ifndef GLINT_ACCEL_BVH_BUILD_H
#define GLINT_ACCEL_BVH_BUILD_H

#include "accel/bvh.h"

// Builds a tree. The same input gives the same tree. Triangles without area are left out, that is,
// triangles whose stored corners are in line; so no ray hits them by rounding. A loader drops them,
// but scenes made by hand may hold some. Two triangles of a cluster share a vertex if its position
// and normal have the same bits. Errors: GLINT_OUT_OF_MEMORY, GLINT_BAD_INPUT (too many triangles
// for the layout).
glint_status glint_bvh_build(const glint_bvh_inputs *inputs, glint_bvh *bvh, glint_error *error);
void glint_bvh_free(glint_bvh *bvh);

// Fits a tree to the same triangles after they moved. This takes a fraction of the time of a build.
// Rays hit the same triangles as in a new tree; report.sah_cost tells how much longer they search.
// Returns false if the tree does not serve: another number of triangles, or of triangles with an
// area; triangles that shared a vertex came apart; too little memory. The caller then frees the
// tree.
bool glint_bvh_refit(const glint_bvh_inputs *inputs, glint_bvh *bvh);

#endif
