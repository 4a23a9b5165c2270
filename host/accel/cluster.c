// A cluster's arrays. See cluster.h.
#include "accel/cluster.h"

#include <float.h>
#include <math.h>
#include <string.h>

_Static_assert(sizeof(glint_cluster) == GLINT_CLUSTER_VALUES * sizeof(float) &&
                   offsetof(glint_cluster, corners) == GLINT_CLUSTER_CORNERS * sizeof(float) &&
                   offsetof(glint_cluster, count) == GLINT_CLUSTER_COUNT * sizeof(float) &&
                   offsetof(glint_cluster, material) == GLINT_CLUSTER_MATERIAL * sizeof(float) &&
                   offsetof(glint_cluster, longest) == GLINT_CLUSTER_LONGEST * sizeof(float) &&
                   offsetof(glint_cluster, curvature) == GLINT_CLUSTER_CURVATURE * sizeof(float),
               "glint_cluster differs from kernels/layout.h");

// values[axis][lane] of each vertex of the leaf.
static void gather(const float *from, const glint_leaf *leaf, float *values)
{
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        size_t triangle = leaf->triangles[leaf->sources[lane] / 4];
        const float *v = from + 9 * triangle + 3 * (leaf->sources[lane] % 4);
        for (int axis = 0; axis < 3; axis++) {
            values[axis * GLINT_CLUSTER_LANES + lane] = v[axis];
        }
    }
}

// From vertex a to vertex b of [axis][lane].
static void difference(const float *values, int a, int b, float along[3])
{
    for (int axis = 0; axis < 3; axis++) {
        along[axis] =
            values[axis * GLINT_CLUSTER_LANES + b] - values[axis * GLINT_CLUSTER_LANES + a];
    }
}

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void glint_cluster_measure(glint_cluster *cluster, const float *normals)
{
    float longest = 0, most = 0, parted = 0; // squares, and the sum of how far normals part
    for (int i = 0; i < 3 * cluster->count; i++) {
        const int k = i % 3, triangle = i / 3;
        const int a = cluster->corners[k][triangle], b = cluster->corners[(k + 1) % 3][triangle];
        float edge[3], turn[3];
        difference(cluster->positions[0], a, b, edge);
        const float squared = dot(edge, edge);
        longest = fmaxf(longest, squared);
        if (normals != NULL && squared > 0) {
            difference(normals, a, b, turn);
            most = fmaxf(most, dot(turn, turn) / squared);
            parted += dot(turn, edge);
        }
    }
    cluster->longest = sqrtf(longest) * (1 + 8 * FLT_EPSILON);
    cluster->curvature = copysignf(sqrtf(most), parted);
}

void glint_cluster_fill(const glint_bvh_inputs *in, const glint_leaf *leaf, const glint_bvh *bvh,
                        size_t index)
{
    glint_cluster *cluster = &bvh->clusters[index];
    int32_t *numbers = bvh->numbers + index * GLINT_CLUSTER_LANES;
    *cluster = (glint_cluster){
        .count = leaf->count,
        .material = (int32_t)in->material_of[leaf->triangles[0]],
    };
    memcpy(cluster->corners, leaf->corners, sizeof cluster->corners);
    gather(in->positions, leaf, cluster->positions[0]);
    float *normals = NULL;
    if (in->normals != NULL) {
        normals = bvh->normals + index * GLINT_CLUSTER_NORMALS;
        gather(in->normals, leaf, normals);
    }
    glint_cluster_measure(cluster, normals);
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        numbers[lane] = lane < leaf->count ? (int32_t)leaf->triangles[lane] : -1;
    }
}
