// The nodes and leaves of the binary tree that the builder makes first, and the memory they use.
#ifndef GLINT_ACCEL_BINARY_NODE_H
#define GLINT_ACCEL_BINARY_NODE_H

#include "accel/box.h"
#include "accel/bvh.h"

#include <stddef.h>
#include <stdint.h>

#define GLINT_WIDTH_MAX 16 // most children of a wide node

// The contents of a leaf's cluster.
typedef struct glint_leaf {
    int count;                               // number of triangles
    uint32_t triangles[GLINT_CLUSTER_LANES]; // numbers of the triangles in the scene
    uint8_t corners[3][GLINT_CLUSTER_LANES]; // the lane of each corner's vertex, as in the cluster
    uint8_t sources[GLINT_CLUSTER_LANES]; // the corner that gives each lane's vertex: 4 × triangle
                                          // + corner
} glint_leaf;

// An inner node, or a leaf. `shares` holds the best way to make wide nodes of the subtree:
//   shares[0]       if this node becomes a wide node: how many of its children come from the left
//                   child's subtree; the others come from the right child's subtree
//   shares[i], i≥2  if i children of a wide node above stand for this subtree: how many of them
//                   come from the left child's subtree; 0: i − 1 children do as well
typedef struct glint_binary_node {
    glint_box bounds;
    struct glint_binary_node *children; // two; NULL: a leaf
    glint_leaf *leaf;
    uint32_t cluster_count; // leaves of the subtree
    uint8_t shares[GLINT_WIDTH_MAX + 1];
} glint_binary_node;

// Memory that is handed out in pieces and freed as a whole. Zero is valid.
typedef struct glint_arena {
    struct glint_arena_block *blocks;
    size_t used; // bytes of the newest block that are in use
} glint_arena;

// Returns `bytes`, at most 4096, aligned to 16, not initialised; NULL if memory is short.
void *glint_arena_take(glint_arena *arena, size_t bytes);
void glint_arena_free(glint_arena *arena);

#endif
