// Builds the wide tree: first a binary tree by the surface area heuristic, then wide nodes from it.
// The leaves become clusters. See bvh_build.h.
#include "accel/bvh_build.h"

#include "accel/binary_tree.h"
#include "accel/collapse.h"
#include "base/memory.h"

#include <stdlib.h>

static double ratio(size_t a, size_t b)
{
    return b > 0 ? (double)a / (double)b : 0;
}

// Completes the report. `triangle_count` counts the triangles with an area.
static void finish_report(glint_bvh *bvh, size_t triangle_count)
{
    const size_t node_bytes = GLINT_NODE_VALUES * (size_t)bvh->width * sizeof(float);
    const size_t normals = bvh->normals != NULL ? GLINT_CLUSTER_NORMALS * sizeof(float) : 0;
    const size_t numbers = GLINT_CLUSTER_LANES * sizeof(int32_t);
    glint_bvh_report *report = &bvh->report;
    report->triangle_count = triangle_count;
    report->node_count = bvh->node_count;
    report->cluster_count = bvh->cluster_count;
    report->fill = ratio(triangle_count, bvh->cluster_count * GLINT_CLUSTER_LANES);
    report->bytes = bvh->node_count * node_bytes +
                    bvh->cluster_count * (sizeof(glint_cluster) + normals + numbers);
    report->bytes_per_triangle = ratio(report->bytes, triangle_count);
}

// Makes a root whose children no ray meets, for a scene whose triangles all have no area.
static bool make_empty_root(glint_bvh *bvh)
{
    const size_t boxes = 6 * (size_t)bvh->width, values = GLINT_NODE_VALUES * (size_t)bvh->width;
    bvh->nodes = glint_allocate(values, sizeof *bvh->nodes);
    for (size_t i = 0; bvh->nodes != NULL && i < boxes; i++) {
        bvh->nodes[i] = GLINT_FAR;
    }
    bvh->node_count = 1;
    bvh->report.depth = 1;
    return bvh->nodes != NULL;
}

glint_status glint_bvh_build(const glint_bvh_inputs *in, glint_bvh *bvh, glint_error *error)
{
    const size_t count = in->triangle_count;
    *bvh = (glint_bvh){.width = in->width, .input_count = count};
    if (count == 0) {
        return GLINT_OK;
    }
    if (count > GLINT_TRIANGLES_MAX) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%zu triangles are more than this version can index (at most %u)", count,
                          GLINT_TRIANGLES_MAX);
    }
    glint_binary_tree tree;
    bool done = glint_binary_tree_build(in, &tree);
    const size_t kept = tree.triangle_count;
    if (done) {
        done = kept > 0 ? glint_collapse(in, &tree.root, &tree.costs, bvh) : make_empty_root(bvh);
    }
    glint_binary_tree_free(&tree);
    if (!done) {
        glint_bvh_free(bvh);
        return glint_fail_memory(error, "the tree");
    }
    finish_report(bvh, kept);
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
