// Builds the whole binary tree. All threads together divide its upper levels, level by level. Below
// them, each range of triangles is left to one thread.
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
    glint_arena *arenas; // the memory of the tree
    size_t arena_count;
    size_t triangle_count; // triangles with an area
} glint_binary_tree;

// Builds the tree of the triangles that have an area. If there are none, there is no root. Returns
// false if memory is short. The caller frees the tree in either case.
bool glint_binary_tree_build(const glint_bvh_inputs *in, glint_binary_tree *tree);
void glint_binary_tree_free(glint_binary_tree *tree);

#endif
