// Splitting a range of references in two by the surface area heuristic over binned centroids (Wald,
// On fast Construction of SAH-based Bounding Volume Hierarchies, 2007).
#ifndef GLINT_ACCEL_SPLIT_H
#define GLINT_ACCEL_SPLIT_H

#include "accel/reference.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_BINS 16

// What falls into one bin. A cache line, so that its place is found by a shift.
typedef struct glint_bin {
    _Alignas(64) glint_box box;
    uint32_t references, triangles;
} glint_bin;

typedef struct glint_bins {
    glint_bin axes[3][GLINT_BINS];
} glint_bins;

// How a reference finds its bins: (middle − low) × scale, rounded down, on each axis.
typedef struct glint_binning {
    glint_float4 low, scale;
} glint_binning;

typedef struct glint_split {
    int axis;
    int bin; // the first of the right side
    // Of either side:
    size_t references[2], triangles[2];
    glint_box bounds[2];
} glint_split;

// What takes a distance of at most `extent` to a number that is, rounded down, below `bins`: 0
// where there is no extent.
float glint_bin_scale(float extent, int bins);

// For references whose middles, twice their boxes' centres, lie in the given box.
glint_binning glint_binning_of(glint_box middles);

void glint_bins_fill(glint_bins *bins, const glint_binning *binning,
                     const glint_reference *references, size_t count);
void glint_bins_merge(glint_bins *bins, const glint_bins *more);

// The references of a set of bins that a split puts on the left.
size_t glint_bins_left_count(const glint_bins *bins, const glint_split *split);

// The cheapest split, where a side costs its area times the clusters that its triangles may be
// expected to make. False where all references are in one bin of each axis.
bool glint_split_find(const glint_bins *bins, glint_box bounds, glint_split *split);

// Where a split puts references, left and right, and the boxes of their middles.
typedef struct glint_split_sides {
    glint_reference *references[2];
    glint_box middles[2];
} glint_split_sides;

// Copies the references to either side, in their order, and grows its box.
void glint_split_apply(const glint_split *split, const glint_binning *binning,
                       const glint_reference *references, size_t count, glint_split_sides *sides);

#endif
