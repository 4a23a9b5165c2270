// The middle of the tree: ranges of references that one thread divides until they are treelets.
#ifndef GLINT_ACCEL_RANGE_H
#define GLINT_ACCEL_RANGE_H

#include "accel/binary_node.h"
#include "accel/collapse.h"
#include "accel/split.h"

#include <stdbool.h>
#include <stddef.h>

// Below this depth splits are made in the middle: what bounds the depth on data that degrade the
// heuristic to a chain.
#define GLINT_SAH_DEPTH_LIMIT 96

// Ranges of more triangles are divided as bundles, which costs a quarter of the time and leaves the
// ranges' borders ragged; from here on down, where that would tell, triangle by triangle.
#define GLINT_BUNDLED_MIN 4096

// References that become a subtree. They stand in the first of two arrays; the same places of the
// second are there to divide them into.
typedef struct glint_range {
    glint_binary_node *node; // with its bounds
    glint_reference *references, *spare;
    size_t count, triangle_count;
    glint_box middles; // bounds of the references' doubled centres
    int depth;         // binary nodes above
} glint_range;

// Sets the children's bounds and the sides' ranges, after glint_split_apply has put the references
// into the spare array, the left side first.
void glint_range_divide(const glint_range *range, const glint_split *split,
                        const glint_box middles[2], glint_binary_node children[2],
                        glint_range sides[2]);

// Where no split was found: halves, by place. Sets the children's bounds, and their ranges, which
// share the node's arrays.
void glint_range_halve(const glint_range *range, glint_binary_node children[2],
                       glint_range halves[2]);

// Makes the subtree of a range of bundles. False where memory is short.
bool glint_range_build(const glint_bvh_inputs *in, const glint_range *range, glint_arena *arena,
                       glint_wide_costs *costs);

#endif
