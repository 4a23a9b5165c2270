// The binary tree that the builder makes first: its nodes and leaves, and where they live.
#ifndef GLINT_ACCEL_BINARY_NODE_H
#define GLINT_ACCEL_BINARY_NODE_H

#include "accel/box.h"
#include "accel/bvh.h"

#include <stddef.h>
#include <stdint.h>

#define GLINT_WIDTH_MAX 16 // children of a wide node

// What a leaf's cluster is made of.
typedef struct glint_leaf {
    int count;                               // of triangles
    uint32_t triangles[GLINT_CLUSTER_LANES]; // their numbers
    uint8_t corners[3][GLINT_CLUSTER_LANES]; // the vertices' lanes, as in the cluster
    uint8_t sources[GLINT_CLUSTER_LANES];    // whose corner each vertex is: 4 × lane + corner
} glint_leaf;

// An inner node, or a leaf. How its subtree is best drawn up as wide nodes stands in `shares`:
//   shares[0]       where this node becomes a wide node: how many of that node's children stand for
//                   the left child's subtree; the others stand for the right one's
//   shares[i], i≥2  where a wide node above has i children for this subtree: how many of them stand
//                   for the left child's subtree; 0 where i − 1 do as well
typedef struct glint_binary_node {
    glint_box bounds;
    struct glint_binary_node *children; // two; NULL: a leaf
    glint_leaf *leaf;
    uint32_t cluster_count; // leaves of the subtree
    uint8_t shares[GLINT_WIDTH_MAX + 1];
} glint_binary_node;

// Memory that is given out piece by piece and freed as a whole. Zero is valid.
typedef struct glint_arena {
    struct glint_arena_block *blocks;
    size_t used; // of the newest block
} glint_arena;

// At most 4096 bytes, aligned to 16, not initialised; NULL where memory is short.
void *glint_arena_take(glint_arena *arena, size_t bytes);
void glint_arena_free(glint_arena *arena);

#endif
