// From the binary tree to the wide one.
#ifndef GLINT_ACCEL_COLLAPSE_H
#define GLINT_ACCEL_COLLAPSE_H

#include "accel/binary_node.h"
#include "accel/bvh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// What it costs at least to draw up a subtree as a forest of up to i wide trees, 1 ≤ i ≤ most: the
// sum of the wide nodes' areas. More than `most` trees cost no less.
typedef struct glint_wide_costs {
    int most;
    double cost[GLINT_WIDTH_MAX + 1];
    uint32_t nodes[GLINT_WIDTH_MAX + 1]; // wide nodes
} glint_wide_costs;

// Of a leaf, which is no wide node.
glint_wide_costs glint_wide_costs_of_leaf(void);

// Of an inner node whose bounds and children are set, from its children's; sets what is left of it.
glint_wide_costs glint_wide_costs_join(glint_binary_node *node, int width,
                                       const glint_wide_costs *left, const glint_wide_costs *right);

// Makes the arrays of `bvh` from the whole binary tree and its costs, and notes depth, cost and
// stack need in its report. False where memory is short; what was made stays in `bvh`.
bool glint_collapse(const glint_bvh_inputs *in, const glint_binary_node *root,
                    const glint_wide_costs *costs, glint_bvh *bvh);

#endif
