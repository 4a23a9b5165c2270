// References: the boxes of triangles that the builder sorts. Meshes mostly list neighbours one
// after the other. So in the tree's upper levels up to four triangles with consecutive numbers
// share a reference (a bundle).
#ifndef GLINT_ACCEL_REFERENCE_H
#define GLINT_ACCEL_REFERENCE_H

#include "accel/box.h"
#include "accel/bvh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_BUNDLE_MAX 4 // most triangles of a reference

// The box of some triangles. The fourth lane of its low corner holds their number and count.
typedef glint_box glint_reference;

// Added to the value of the fourth lane, so that its bits are a normal float. Arithmetic on this
// lane has no use, but it would be slow on denormals.
#define GLINT_REFERENCE_BITS 0x40000000u

static inline uint32_t glint_reference_lane(glint_reference reference)
{
    float lane = reference.low_negated[3];
    uint32_t bits;
    memcpy(&bits, &lane, sizeof bits);
    return bits - GLINT_REFERENCE_BITS;
}

// Returns the number of the first triangle.
static inline uint32_t glint_reference_first(glint_reference reference)
{
    return glint_reference_lane(reference) / GLINT_BUNDLE_MAX;
}

// Returns the number of triangles, 1 to GLINT_BUNDLE_MAX.
static inline uint32_t glint_reference_count(glint_reference reference)
{
    return glint_reference_lane(reference) % GLINT_BUNDLE_MAX + 1;
}

// Makes references to `count` triangles from number `first` on, a multiple of GLINT_BUNDLE_MAX.
// Bundles triangles whose common box is hardly larger than their own boxes. Leaves out triangles
// without area. Returns the number of references, at most `count`.
size_t glint_references_make(const glint_bvh_inputs *in, size_t first, size_t count,
                             glint_reference *references);

// Makes a single reference to each triangle of some references, in their order.
void glint_references_unbundle(const glint_bvh_inputs *in, const glint_reference *bundles,
                               size_t bundle_count, glint_reference *references);

#endif
