// Builds the tree's lowest levels: divides few triangles into the fewest and smallest clusters.
#ifndef GLINT_ACCEL_TREELET_H
#define GLINT_ACCEL_TREELET_H

#include "accel/binary_node.h"
#include "accel/collapse.h"
#include "accel/split.h"

#include <stdbool.h>
#include <stddef.h>

// A larger treelet takes more time per triangle, and leaves fewer clusters half empty.
#ifndef GLINT_TREELET_MAX
#define GLINT_TREELET_MAX 64
#endif

// 1 to GLINT_TREELET_MAX triangles, and the node that becomes their root. The node's bounds are
// set.
typedef struct glint_treelet_range {
    const glint_reference *references; // one per triangle
    size_t count;
    glint_binary_node *root;
} glint_treelet_range;

// Builds the subtree and its costs. Returns false if memory is short.
bool glint_treelet_build(const glint_bvh_inputs *in, const glint_treelet_range *range,
                         glint_arena *arena, glint_wide_costs *costs);

#endif
