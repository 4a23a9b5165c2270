// Builds the middle of the tree: one thread divides a range of references until they are treelets.
#ifndef GLINT_ACCEL_RANGE_H
#define GLINT_ACCEL_RANGE_H

#include "accel/binary_node.h"
#include "accel/collapse.h"
#include "accel/split.h"

#include <stdbool.h>
#include <stddef.h>

// Below this depth a range is halved. This limits the depth if the heuristic would degrade to a
// chain.
#define GLINT_SAH_DEPTH_LIMIT 96

// Ranges of more triangles than this are divided in bundles. This takes a quarter of the time, but
// leaves the ranges' borders ragged. Smaller ranges, where ragged borders matter, are divided by
// triangles.
#define GLINT_BUNDLED_MIN 4096

// References that become a subtree. They stand in the first array. The division writes them to the
// same places of the second.
typedef struct glint_range {
    glint_binary_node *node; // the subtree's root, with its bounds
    glint_reference *references, *spare;
    size_t count, triangle_count;
    glint_box middles; // bounds of the references' middles (twice their centres)
    int depth;         // number of binary nodes above it
} glint_range;

// Sets the children's bounds and the sides' ranges. Call it after glint_split_apply has put the
// references into the spare array, the left side first.
void glint_range_divide(const glint_range *range, const glint_split *split,
                        const glint_box middles[2], glint_binary_node children[2],
                        glint_range sides[2]);

// Halves a range for which no split was found, by place in the array. Sets the children's bounds
// and ranges, which share the node's arrays.
void glint_range_halve(const glint_range *range, glint_binary_node children[2],
                       glint_range halves[2]);

// Builds the subtree of a range of bundles. Returns false if memory is short.
bool glint_range_build(const glint_bvh_inputs *in, const glint_range *range, glint_arena *arena,
                       glint_wide_costs *costs);

#endif
