// Clusters: the tree's leaves, each of up to 16 triangles of one material and their shared
// vertices.
#ifndef GLINT_ACCEL_CLUSTER_H
#define GLINT_ACCEL_CLUSTER_H

#include "accel/binary_node.h"
#include "accel/box.h"
#include "accel/bvh.h"

#include <stddef.h>
#include <stdint.h>

// The least number of clusters that `triangles` triangles make.
static inline uint32_t glint_clusters_expected(uint32_t triangles)
{
    return (triangles + GLINT_CLUSTER_LANES - 1) / GLINT_CLUSTER_LANES;
}

// The expected cost of a box with `clusters` clusters for a random ray, in arbitrary units. It is
// area times clusters, because all lanes of a cluster are tested at once. For areas of 0 the
// clusters alone decide.
static inline float glint_cluster_cost(glint_box box, float scale, float clusters)
{
    return (glint_box_area(box, scale) + 0x1p-20f) * clusters;
}

// Fills cluster `index` of the tree's arrays.
void glint_cluster_fill(const glint_bvh_inputs *in, const glint_leaf *leaf, const glint_bvh *bvh,
                        size_t index);

#endif
