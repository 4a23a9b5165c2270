// The bounding volume hierarchy: a wide tree over triangles, in the device's layout.
#ifndef GLINT_ACCEL_BVH_H
#define GLINT_ACCEL_BVH_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

// What was built, for `info` and statistics.
typedef struct glint_bvh_report {
    size_t triangle_count;
    size_t node_count;
    size_t leaf_count;
    int depth;       // nodes on the longest way down
    double sah_cost; // expected cost of a random ray, in triangle tests (surface area heuristic)
    double mean_leaf_size; // triangles
    size_t bytes;          // nodes and triangle order
    int stack_need;        // entries that a traversal may have waiting
} glint_bvh_report;

// Zero is valid: a tree without triangles.
typedef struct glint_bvh {
    int width; // children of a node: 8 or 16
    size_t node_count;
    // [node_count][7 × width] 32-bit values, see kernels/layout.h; node 0 is the root. Boxes are
    // widened a little beyond their triangles, so that rounding in the tests of boxes and triangles
    // never leaves a gap between them.
    float *nodes;
    uint32_t *order; // [triangle_count]: the triangle (of the scene) in each place of the leaves
    glint_bvh_report report;
} glint_bvh;

// `positions`: [triangle_count][3][3] finite floats. `width`: 8 or 16. Deterministic: the same
// input gives the same tree. Errors: GLINT_DEVICE_FAILED (memory), GLINT_BAD_INPUT (too many
// triangles for the layout).
glint_status glint_bvh_build(const float *positions, size_t triangle_count, int width,
                             glint_bvh *bvh, glint_error *error);
void glint_bvh_free(glint_bvh *bvh);

#endif
