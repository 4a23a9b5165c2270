// Splits a range of references in two by the surface area heuristic over binned centroids (Wald, On
// fast Construction of SAH-based Bounding Volume Hierarchies, 2007).
#ifndef GLINT_ACCEL_SPLIT_H
#define GLINT_ACCEL_SPLIT_H

#include "accel/reference.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_BINS 16

// The contents of one bin. It fills a cache line, so that a shift finds its place.
typedef struct glint_bin {
    _Alignas(64) glint_box box;
    uint32_t references, triangles;
} glint_bin;

typedef struct glint_bins {
    glint_bin axes[3][GLINT_BINS];
} glint_bins;

// Maps a reference to its bins: (middle − low) × scale, rounded down, on each axis.
typedef struct glint_binning {
    glint_float4 low, scale;
} glint_binning;

typedef struct glint_split {
    int axis;
    int bin; // first bin of the right side
    // Of the left and the right side:
    size_t references[2], triangles[2];
    glint_box bounds[2];
} glint_split;

// Returns the factor that maps distances of 0 to `extent` to numbers that are below `bins` when
// rounded down. 0 if the extent is 0.
float glint_bin_scale(float extent, int bins);

// Makes the map for references whose middles (twice their centres) lie in the box `middles`.
glint_binning glint_binning_of(glint_box middles);

void glint_bins_fill(glint_bins *bins, const glint_binning *binning,
                     const glint_reference *references, size_t count);
void glint_bins_merge(glint_bins *bins, const glint_bins *more);

// Returns how many of the binned references a split puts on the left.
size_t glint_bins_left_count(const glint_bins *bins, const glint_split *split);

// Finds the cheapest split. A side costs its area times the number of clusters that it is expected
// to make. Returns false if on each axis all references are in one bin.
bool glint_split_find(const glint_bins *bins, glint_box bounds, glint_split *split);

// The two outputs of a split: references, and the boxes of their middles.
typedef struct glint_split_sides {
    glint_reference *references[2];
    glint_box middles[2];
} glint_split_sides;

// Copies each reference to its side, in order, and grows the side's box.
void glint_split_apply(const glint_split *split, const glint_binning *binning,
                       const glint_reference *references, size_t count, glint_split_sides *sides);

#endif
