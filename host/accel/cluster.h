// Clusters: the tree's leaves. Up to 16 triangles of one material and the vertices that they share.
#ifndef GLINT_ACCEL_CLUSTER_H
#define GLINT_ACCEL_CLUSTER_H

#include "accel/bvh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// True if the triangles, named by their numbers, make one cluster: at most 16, of one material,
// with at most 16 distinct vertices.
bool glint_cluster_fits(const glint_bvh_inputs *in, const uint32_t *triangles, size_t count);

// Fills cluster `index` of the tree's arrays with 1 to 16 triangles that fit.
void glint_cluster_fill(const glint_bvh_inputs *in, const uint32_t *triangles, size_t count,
                        const glint_bvh *bvh, size_t index);

#endif
