// What the builder sorts: boxes of triangles. Up to four triangles whose numbers follow each other
// share one while the tree's upper levels are made, as meshes mostly list neighbours one after the
// other.
#ifndef GLINT_ACCEL_REFERENCE_H
#define GLINT_ACCEL_REFERENCE_H

#include "accel/box.h"
#include "accel/bvh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define GLINT_BUNDLE_MAX 4 // triangles of a reference

// The box of some triangles; the fourth lane of its low corner says which.
typedef glint_box glint_reference;

// Added to what the fourth lane holds, so that it is the bits of a normal float: arithmetic on that
// lane, whose results nobody reads, would be slow on denormals.
#define GLINT_REFERENCE_BITS 0x40000000u

static inline uint32_t glint_reference_lane(glint_reference reference)
{
    float lane = reference.low_negated[3];
    uint32_t bits;
    memcpy(&bits, &lane, sizeof bits);
    return bits - GLINT_REFERENCE_BITS;
}

// The number of the first triangle.
static inline uint32_t glint_reference_first(glint_reference reference)
{
    return glint_reference_lane(reference) / GLINT_BUNDLE_MAX;
}

// How many triangles there are, 1 to GLINT_BUNDLE_MAX.
static inline uint32_t glint_reference_count(glint_reference reference)
{
    return glint_reference_lane(reference) % GLINT_BUNDLE_MAX + 1;
}

// Makes references to `count` triangles from number `first` on, a multiple of GLINT_BUNDLE_MAX;
// those whose common box is hardly larger than their own are bundled. Triangles without area are
// left out. Returns the number of references, at most `count`.
size_t glint_references_make(const glint_bvh_inputs *in, size_t first, size_t count,
                             glint_reference *references);

// Makes a reference to each triangle of some references, in their order.
void glint_references_unbundle(const float *positions, const glint_reference *bundles,
                               size_t bundle_count, glint_reference *references);

#endif
