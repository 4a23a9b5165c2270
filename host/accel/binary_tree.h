// The whole binary tree: its upper levels are divided by all threads together, level by level, and
// what is below by one thread each.
#ifndef GLINT_ACCEL_BINARY_TREE_H
#define GLINT_ACCEL_BINARY_TREE_H

#include "accel/binary_node.h"
#include "accel/collapse.h"

#include <stdbool.h>
#include <stddef.h>

// Zero is valid: no tree.
typedef struct glint_binary_tree {
    glint_binary_node root;
    glint_wide_costs costs;
    glint_arena *arenas; // of what the tree is made
    size_t arena_count;
    size_t triangle_count; // that have an area
} glint_binary_tree;

// Builds the tree of the triangles that have an area; without any there is no root. False where
// memory is short; the tree is to be freed in either case.
bool glint_binary_tree_build(const glint_bvh_inputs *in, glint_binary_tree *tree);
void glint_binary_tree_free(glint_binary_tree *tree);

#endif
