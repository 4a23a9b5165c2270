// The bounding volume hierarchy: a wide tree over triangles, in the device's layout.
#ifndef GLINT_ACCEL_BVH_H
#define GLINT_ACCEL_BVH_H

#include "base/status.h"
#include "kernels/layout.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// For each triangle, at most, beside the scene; the tree itself takes half of it.
#define GLINT_BVH_BYTES_WHILE_BUILT 75

// A leaf's triangles as the host sees them; the values are described in kernels/layout.h.
typedef struct glint_cluster {
    float positions[3][GLINT_CLUSTER_LANES]; // x, y, z of each vertex
    uint8_t corners[3][GLINT_CLUSTER_LANES]; // first, second, third corner of each triangle
    int32_t facts;                           // see glint_cluster_count and glint_cluster_material
    float anchor[3];
} glint_cluster;

static inline int32_t glint_cluster_count(const glint_cluster *cluster)
{
    return cluster->facts & GLINT_CLUSTER_COUNT_MASK;
}

static inline int32_t glint_cluster_material(const glint_cluster *cluster)
{
    return cluster->facts >> GLINT_CLUSTER_COUNT_BITS;
}

// What was built, for `info` and statistics.
typedef struct glint_bvh_report {
    size_t triangle_count; // that have an area
    size_t node_count;
    size_t cluster_count;
    int depth;        // nodes on the longest way down
    double sah_cost;  // nodes and clusters that a random ray through the root's box may be expected
                      // to meet (surface area heuristic)
    double root_area; // half of the surface area of the root's box, stored units squared
    double fill;      // share of the clusters' lanes that hold a triangle
    size_t bytes;     // of all arrays
    double bytes_per_triangle;
    bool is_refitted; // to triangles that had moved, since it was built
    int stack_need;   // entries that a traversal may have waiting
} glint_bvh_report;

// Zero is valid: a tree without triangles. All arrays are aligned to 64 bytes.
typedef struct glint_bvh {
    int width; // children of a node: 8 or 16
    size_t node_count, cluster_count;
    size_t input_count; // triangles that it was made from, those without area too
    // [node_count][7 × width] 32-bit values, see kernels/layout.h; node 0 is the root. Boxes are
    // widened a little beyond their triangles, so that rounding in the tests of boxes and triangles
    // never leaves a gap between them.
    float *nodes;
    glint_cluster *clusters; // [cluster_count]
    float *normals;          // [cluster_count][GLINT_CLUSTER_NORMALS], or NULL without normals
    int32_t *numbers;        // [cluster_count][GLINT_CLUSTER_LANES]
    glint_bvh_report report;
} glint_bvh;

// Triangles as a scene holds them. Pointers are borrowed.
typedef struct glint_bvh_inputs {
    const float *positions;      // [triangle_count][3 vertices][3], magnitudes below GLINT_FAR
    const float *told;           // the same from the anchors of parts; NULL: there are no parts
    const uint32_t *part_of;     // [triangle_count], where there are
    const float (*anchors)[3];   // of the parts
    const float *normals;        // the same shape as positions, or NULL
    const uint32_t *material_of; // [triangle_count]
    size_t triangle_count;
    int width;      // children of a node: 8 or 16
    size_t threads; // 0: as many as there are cores; the tree is the same for any number
} glint_bvh_inputs;

// What clusters hold of the triangles' corners.
static inline const float *glint_bvh_told(const glint_bvh_inputs *in)
{
    return in->told != NULL ? in->told : in->positions;
}

// The anchor that a triangle's corners are told from.
static inline const float *glint_bvh_anchor(const glint_bvh_inputs *in, size_t triangle)
{
    static const float origin[3] = {0, 0, 0};
    return in->told != NULL ? in->anchors[in->part_of[triangle]] : origin;
}

// Triangles of one group may stand in one cluster: they have one material and one anchor.
static inline uint64_t glint_bvh_group(const glint_bvh_inputs *in, size_t triangle)
{
    const uint64_t part = in->told != NULL ? in->part_of[triangle] : 0;
    return part << 32 | in->material_of[triangle];
}

// Deterministic: the same input gives the same tree. Triangles without area, whose corners are in
// line as they are stored (a loader keeps them out, but scenes are made by hand too), are left out:
// no ray hits them, whatever rounding makes of them. Two triangles of a cluster share a vertex
// where its position and normal have the same bits. Errors: GLINT_OUT_OF_MEMORY,
// GLINT_BAD_INPUT (too many triangles for the layout).
glint_status glint_bvh_build(const glint_bvh_inputs *inputs, glint_bvh *bvh, glint_error *error);
void glint_bvh_free(glint_bvh *bvh);

// Fits a tree to the same triangles at other places, which takes a fraction of the time: what rays
// hit is the same as in a tree that is built anew, but report.sah_cost tells how much longer they
// take to find it. False where the tree does not serve (another number of triangles, or of those
// with an area; triangles that shared a vertex came apart; too little memory): it is then to be
// freed.
bool glint_bvh_refit(const glint_bvh_inputs *inputs, glint_bvh *bvh);

#endif
