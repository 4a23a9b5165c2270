// Clusters: the tree's leaves. Up to 16 triangles of one material and the vertices that they share.
#ifndef GLINT_ACCEL_CLUSTER_H
#define GLINT_ACCEL_CLUSTER_H

#include "accel/binary_node.h"
#include "accel/box.h"
#include "accel/bvh.h"

#include <stddef.h>
#include <stdint.h>

// Clusters that so many triangles may be expected to make; 1 if they may make one.
static inline uint32_t glint_clusters_expected(uint32_t triangles)
{
    return (triangles + GLINT_CLUSTER_LANES - 1) / GLINT_CLUSTER_LANES;
}

// What a box with so many clusters costs a random ray, in arbitrary units: area times clusters, as
// all lanes of a cluster are tested at once. Where areas are 0 the clusters alone decide.
static inline float glint_cluster_cost(glint_box box, float scale, float clusters)
{
    return (glint_box_area(box, scale) + 0x1p-20f) * clusters;
}

// Fills cluster `index` of the tree's arrays.
void glint_cluster_fill(const glint_bvh_inputs *in, const glint_leaf *leaf, const glint_bvh *bvh,
                        size_t index);

#endif
