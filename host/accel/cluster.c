// Fills a cluster's arrays. See cluster.h.
#include "accel/cluster.h"

#include <string.h>

_Static_assert(sizeof(glint_cluster) == GLINT_CLUSTER_VALUES * sizeof(float) &&
                   offsetof(glint_cluster, corners) == GLINT_CLUSTER_CORNERS * sizeof(float) &&
                   offsetof(glint_cluster, facts) == GLINT_CLUSTER_FACTS * sizeof(float) &&
                   offsetof(glint_cluster, anchor) == GLINT_CLUSTER_ANCHOR * sizeof(float),
               "glint_cluster differs from kernels/layout.h");

// Writes values[axis][lane] of the vertices of a leaf.
static void gather(const glint_bvh_inputs *in, glint_bvh_value *value_at, const glint_leaf *leaf,
                   float *values)
{
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        size_t triangle = leaf->triangles[leaf->sources[lane] / 4];
        const float *v = value_at(in, triangle, leaf->sources[lane] % 4);
        for (int axis = 0; axis < 3; axis++) {
            values[axis * GLINT_CLUSTER_LANES + lane] = v[axis];
        }
    }
}

void glint_cluster_fill(const glint_bvh_inputs *in, const glint_leaf *leaf, const glint_bvh *bvh,
                        size_t index)
{
    glint_cluster *cluster = &bvh->clusters[index];
    int32_t *numbers = bvh->numbers + index * GLINT_CLUSTER_LANES;
    *cluster = (glint_cluster){0};
    const uint32_t first = leaf->triangles[0];
    cluster->facts = leaf->count | (int32_t)(in->material_of[first] << GLINT_CLUSTER_COUNT_BITS);
    memcpy(cluster->anchor, glint_bvh_anchor(in, first), sizeof cluster->anchor);
    memcpy(cluster->corners, leaf->corners, sizeof cluster->corners);
    gather(in, glint_bvh_told, leaf, cluster->positions[0]);
    if (in->normals != NULL) {
        gather(in, glint_bvh_normal, leaf, bvh->normals + index * GLINT_CLUSTER_NORMALS);
    }
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        numbers[lane] = lane < leaf->count ? (int32_t)leaf->triangles[lane] : -1;
    }
}
