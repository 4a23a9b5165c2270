// Collapses the binary tree to the wide tree.
#ifndef GLINT_ACCEL_COLLAPSE_H
#define GLINT_ACCEL_COLLAPSE_H

#include "accel/binary_node.h"
#include "accel/bvh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The costs of a subtree as a forest of up to i wide trees, 1 ≤ i ≤ most: the least sum of the wide
// nodes' areas. More than `most` trees do not cost less.
typedef struct glint_wide_costs {
    int most;
    double cost[GLINT_WIDTH_MAX + 1];
    uint32_t nodes[GLINT_WIDTH_MAX + 1]; // number of wide nodes
} glint_wide_costs;

// Returns the costs of a leaf, which is no wide node.
glint_wide_costs glint_wide_costs_of_leaf(void);

// Returns the costs of an inner node from its children's costs. The node's bounds and children are
// set; sets its other members.
glint_wide_costs glint_wide_costs_join(glint_binary_node *node, int width,
                                       const glint_wide_costs *left, const glint_wide_costs *right);

// Makes the arrays of `bvh` from the binary tree and its costs. Writes depth, cost and stack need
// to its report. Returns false if memory is short; `bvh` then keeps the arrays made so far.
bool glint_collapse(const glint_bvh_inputs *in, const glint_binary_node *root,
                    const glint_wide_costs *costs, glint_bvh *bvh);

#endif
