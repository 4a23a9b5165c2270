// Fits a tree to triangles that have moved. Clusters keep their triangles and nodes their children.
// Every box is computed anew, from the leaves up. See bvh_build.h.
#include "accel/bvh_build.h"

#include "accel/box.h"
#include "accel/wide_box.h"
#include "base/memory.h"
#include "base/parallel.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

typedef struct refit {
    const glint_bvh_inputs *in;
    const glint_bvh *bvh;
    glint_box *boxes;     // [cluster_count], then [node_count]
    atomic_bool has_torn; // a cluster's triangles no longer belong together
} refit;

// True if each triangle of a cluster still has an area, the cluster's material and the same anchor.
static bool is_whole(const glint_bvh_inputs *in, const glint_cluster *cluster,
                     const int32_t *numbers)
{
    const uint64_t group = glint_bvh_group(in, (size_t)numbers[0]);
    if ((uint32_t)group != (uint32_t)glint_cluster_material(cluster)) {
        return false;
    }
    for (int k = 0; k < glint_cluster_count(cluster); k++) {
        const size_t number = (size_t)numbers[k];
        if (glint_bvh_group(in, number) != group || !glint_bvh_has_area(in, number)) {
            return false;
        }
    }
    return true;
}

static bool have_same_bits(float a, float b)
{
    uint32_t bits[2];
    memcpy(&bits[0], &a, sizeof a);
    memcpy(&bits[1], &b, sizeof b);
    return bits[0] == bits[1];
}

// Writes values[axis][lane] of each vertex from its triangles. Returns false if two triangles that
// shared a vertex came apart; `values` are then undefined.
static bool gather(const refit *r, glint_bvh_value *value_at, const glint_cluster *cluster,
                   const int32_t *numbers, float *values)
{
    bool is_set[GLINT_CLUSTER_LANES] = {false};
    for (int k = 0; k < glint_cluster_count(cluster); k++) {
        for (size_t corner = 0; corner < 3; corner++) {
            const int lane = cluster->corners[corner][k];
            const float *v = value_at(r->in, (size_t)numbers[k], corner);
            for (int axis = 0; axis < 3; axis++) {
                float *value = &values[axis * GLINT_CLUSTER_LANES + lane];
                if (is_set[lane] && !have_same_bits(*value, v[axis])) {
                    return false;
                }
                *value = v[axis];
            }
            is_set[lane] = true;
        }
    }
    // Unused lanes repeat the first vertex.
    for (int lane = 1; lane < GLINT_CLUSTER_LANES; lane++) {
        for (int axis = 0; axis < 3 && !is_set[lane]; axis++) {
            values[axis * GLINT_CLUSTER_LANES + lane] = values[axis * GLINT_CLUSTER_LANES];
        }
    }
    return is_set[0];
}

static glint_box cluster_box(const glint_cluster *cluster)
{
    glint_box box = glint_box_empty();
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        const glint_float4 point = {cluster->anchor[0] + cluster->positions[0][lane],
                                    cluster->anchor[1] + cluster->positions[1][lane],
                                    cluster->anchor[2] + cluster->positions[2][lane], 0};
        box = glint_box_union(box, glint_box_of(point));
    }
    return box;
}

#define CLUSTERS_PER_TASK 256

static void refit_some(size_t task, void *context)
{
    refit *r = context;
    const glint_bvh *bvh = r->bvh;
    const size_t first = task * CLUSTERS_PER_TASK;
    for (size_t i = first; i < first + CLUSTERS_PER_TASK && i < bvh->cluster_count; i++) {
        glint_cluster *cluster = &bvh->clusters[i];
        const int32_t *numbers = bvh->numbers + i * GLINT_CLUSTER_LANES;
        if (!is_whole(r->in, cluster, numbers) ||
            !gather(r, glint_bvh_told, cluster, numbers, cluster->positions[0]) ||
            (bvh->normals != NULL && !gather(r, glint_bvh_normal, cluster, numbers,
                                             bvh->normals + i * GLINT_CLUSTER_NORMALS))) {
            atomic_store(&r->has_torn, true);
            return;
        }
        memcpy(cluster->anchor, glint_bvh_anchor(r->in, (size_t)numbers[0]),
               sizeof cluster->anchor);
        r->boxes[i] = cluster_box(cluster);
    }
}

// Computes the nodes' boxes. Children stand behind their node, so the loop runs from the last node.
static void refit_nodes(const refit *r, glint_bvh *bvh)
{
    const int width = bvh->width;
    glint_box *nodes = r->boxes + bvh->cluster_count;
    double areas = 0;
    for (size_t index = bvh->node_count; index-- > 0;) {
        float *node = bvh->nodes + index * GLINT_NODE_VALUES * (size_t)width;
        glint_box bounds = glint_box_empty();
        for (int i = 0; i < width; i++) {
            int32_t child;
            memcpy(&child, node + 6 * width + i, sizeof child);
            if (child == 0) { // no child: the root has index 0 and is nobody's child
                continue;
            }
            const glint_box box = child < 0 ? r->boxes[~child] : nodes[child];
            glint_wide_store_box(node, width, i, box);
            bounds = glint_box_union(bounds, box);
            areas += child < 0 ? glint_wide_area(box) : 0;
        }
        nodes[index] = bounds;
        areas += glint_wide_area(bounds);
    }
    bvh->report.is_refitted = true;
    bvh->report.root_area = glint_wide_area(nodes[0]);
    bvh->report.sah_cost = areas / fmax(bvh->report.root_area, 1e-300);
}

static size_t count_with_area(const glint_bvh_inputs *in)
{
    size_t count = 0;
    for (size_t i = 0; i < in->triangle_count; i++) {
        count += glint_bvh_has_area(in, i);
    }
    return count;
}

bool glint_bvh_refit(const glint_bvh_inputs *in, glint_bvh *bvh)
{
    if (bvh->cluster_count == 0 || in->width != bvh->width ||
        in->triangle_count != bvh->input_count || (in->normals != NULL) != (bvh->normals != NULL)) {
        return false;
    }
    // The clusters' triangles are checked later. Here: no triangle outside the clusters gained an
    // area.
    if (bvh->report.triangle_count != in->triangle_count &&
        bvh->report.triangle_count != count_with_area(in)) {
        return false;
    }
    refit r = {.in = in,
               .bvh = bvh,
               .boxes =
                   glint_allocate_unset(bvh->cluster_count + bvh->node_count, sizeof *r.boxes)};
    if (r.boxes == NULL) {
        return false;
    }
    const size_t tasks = (bvh->cluster_count + CLUSTERS_PER_TASK - 1) / CLUSTERS_PER_TASK;
    glint_parallel_for_on(in->threads, tasks, refit_some, &r);
    const bool fits = !atomic_load(&r.has_torn);
    if (fits) {
        refit_nodes(&r, bvh);
    }
    free(r.boxes);
    return fits;
}
