// Builds the wide tree: a binary tree by the surface area heuristic, drawn up as wide nodes, its
// leaves as clusters. See bvh.h.
#include "accel/bvh.h"

#include "accel/binary_tree.h"
#include "accel/collapse.h"

#include <stdlib.h>

static void finish_report(glint_bvh *bvh, size_t triangle_count)
{
    const size_t node_bytes = GLINT_NODE_VALUES * (size_t)bvh->width * sizeof(float);
    const size_t normals = bvh->normals != NULL ? GLINT_CLUSTER_NORMALS * sizeof(float) : 0;
    const size_t numbers = GLINT_CLUSTER_LANES * sizeof(int32_t);
    glint_bvh_report *report = &bvh->report;
    report->triangle_count = triangle_count;
    report->node_count = bvh->node_count;
    report->cluster_count = bvh->cluster_count;
    report->fill = (double)triangle_count / ((double)bvh->cluster_count * GLINT_CLUSTER_LANES);
    report->bytes = bvh->node_count * node_bytes +
                    bvh->cluster_count * (sizeof(glint_cluster) + normals + numbers);
    report->bytes_per_triangle = (double)report->bytes / (double)triangle_count;
}

glint_status glint_bvh_build(const glint_bvh_inputs *in, glint_bvh *bvh, glint_error *error)
{
    const size_t count = in->triangle_count;
    *bvh = (glint_bvh){.width = in->width};
    if (count == 0) {
        return GLINT_OK;
    }
    if (count > GLINT_TRIANGLES_MAX) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%zu triangles are more than this version can index (at most %u)", count,
                          GLINT_TRIANGLES_MAX);
    }
    glint_binary_tree tree;
    bool done =
        glint_binary_tree_build(in, &tree) && glint_collapse(in, &tree.root, &tree.costs, bvh);
    glint_binary_tree_free(&tree);
    if (!done) {
        glint_bvh_free(bvh);
        return glint_fail_memory(error, "the tree");
    }
    finish_report(bvh, count);
    return GLINT_OK;
}

void glint_bvh_free(glint_bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->clusters);
    free(bvh->normals);
    free(bvh->numbers);
    *bvh = (glint_bvh){0};
}
