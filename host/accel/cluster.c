// Clusters: which triangles make one, and its arrays. See cluster.h.
#include "accel/cluster.h"

#include <string.h>

_Static_assert(sizeof(glint_cluster) == GLINT_CLUSTER_VALUES * sizeof(float) &&
                   offsetof(glint_cluster, corners) == GLINT_CLUSTER_CORNERS * sizeof(float) &&
                   offsetof(glint_cluster, count) == GLINT_CLUSTER_COUNT * sizeof(float) &&
                   offsetof(glint_cluster, material) == GLINT_CLUSTER_MATERIAL * sizeof(float),
               "glint_cluster differs from kernels/layout.h");

// The distinct vertices of a cluster: position and normal, compared as bits.
typedef struct vertex_set {
    uint32_t values[GLINT_CLUSTER_LANES][6];
    int count;
} vertex_set;

static void load_vertex(const glint_bvh_inputs *in, size_t vertex, uint32_t values[6])
{
    memset(values, 0, 6 * sizeof *values);
    memcpy(values, in->positions + 3 * vertex, 3 * sizeof *values);
    if (in->normals != NULL) {
        memcpy(values + 3, in->normals + 3 * vertex, 3 * sizeof *values);
    }
}

// The vertex's lane, which is new if the set did not hold it; −1 if there is no room.
static int lane_of(vertex_set *set, const uint32_t values[6])
{
    for (int lane = 0; lane < set->count; lane++) {
        if (memcmp(set->values[lane], values, sizeof set->values[lane]) == 0) {
            return lane;
        }
    }
    if (set->count == GLINT_CLUSTER_LANES) {
        return -1;
    }
    memcpy(set->values[set->count], values, sizeof set->values[set->count]);
    return set->count++;
}

bool glint_cluster_fits(const glint_bvh_inputs *in, const uint32_t *triangles, size_t count)
{
    if (count > GLINT_CLUSTER_LANES) {
        return false;
    }
    vertex_set set = {.count = 0};
    for (size_t i = 0; i < count; i++) {
        if (in->material_of[triangles[i]] != in->material_of[triangles[0]]) {
            return false;
        }
        for (size_t corner = 0; corner < 3; corner++) {
            uint32_t values[6];
            load_vertex(in, 3 * (size_t)triangles[i] + corner, values);
            if (lane_of(&set, values) < 0) {
                return false;
            }
        }
    }
    return true;
}

void glint_cluster_fill(const glint_bvh_inputs *in, const uint32_t *triangles, size_t count,
                        const glint_bvh *bvh, size_t index)
{
    glint_cluster *cluster = &bvh->clusters[index];
    int32_t *numbers = bvh->numbers + index * GLINT_CLUSTER_LANES;
    vertex_set set = {.count = 0};
    *cluster = (glint_cluster){
        .count = (int32_t)count,
        .material = (int32_t)in->material_of[triangles[0]],
    };
    for (size_t i = 0; i < GLINT_CLUSTER_LANES; i++) {
        numbers[i] = i < count ? (int32_t)triangles[i] : -1;
        for (size_t corner = 0; i < count && corner < 3; corner++) {
            uint32_t values[6];
            load_vertex(in, 3 * (size_t)triangles[i] + corner, values);
            cluster->corners[corner][i] = (uint8_t)lane_of(&set, values);
        }
    }
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        const uint32_t *values = set.values[lane < set.count ? lane : 0];
        for (int k = 0; k < 3; k++) {
            memcpy(&cluster->positions[k][lane], &values[k], sizeof(float));
            if (bvh->normals != NULL) {
                memcpy(bvh->normals + index * GLINT_CLUSTER_NORMALS + k * GLINT_CLUSTER_LANES +
                           lane,
                       &values[3 + k], sizeof(float));
            }
        }
    }
}
