// Makes references, bundled and single. See reference.h.
#include "accel/reference.h"

// True if the common box has hardly more area than the triangles' own boxes together. For four
// triangles of a flat patch both areas are equal; for scattered triangles the common area is many
// times larger. The comparison is written so that areas that overflow make no bundle.
static inline bool belong_together(glint_box common, float areas)
{
    return glint_box_area(common, 1) < 1.25f * areas;
}

static inline glint_float4 point_at(const glint_bvh_inputs *in, size_t triangle, size_t corner)
{
    const float *p = in->positions + 3 * glint_triangle_vertex(in->indices, triangle, corner);
    return (glint_float4){p[0], p[1], p[2], 0};
}

static inline glint_box triangle_box(const glint_bvh_inputs *in, size_t triangle)
{
    const glint_float4 a = point_at(in, triangle, 0);
    const glint_float4 b = point_at(in, triangle, 1);
    const glint_float4 c = point_at(in, triangle, 2);
    return (glint_box){glint_larger4(glint_larger4(-a, -b), -c),
                       glint_larger4(glint_larger4(a, b), c)};
}

static inline glint_reference make(glint_box box, size_t first, uint32_t count)
{
    uint32_t bits = (uint32_t)first * GLINT_BUNDLE_MAX + (count - 1) + GLINT_REFERENCE_BITS;
    float lane;
    memcpy(&lane, &bits, sizeof lane);
    box.low_negated[3] = lane;
    return box;
}

// Makes one reference to two triangles, or two references.
static inline size_t make_pair(const glint_box boxes[2], size_t first, glint_reference *references)
{
    const glint_box common = glint_box_union(boxes[0], boxes[1]);
    if (belong_together(common, glint_box_area(boxes[0], 1) + glint_box_area(boxes[1], 1))) {
        references[0] = make(common, first, 2);
        return 1;
    }
    references[0] = make(boxes[0], first, 1);
    references[1] = make(boxes[1], first + 1, 1);
    return 2;
}

static size_t make_four(const glint_bvh_inputs *in, size_t first, glint_reference *references)
{
    glint_box boxes[4], common = glint_box_empty();
    float areas = 0;
    for (size_t i = 0; i < 4; i++) {
        boxes[i] = triangle_box(in, first + i);
        common = glint_box_union(common, boxes[i]);
        areas += glint_box_area(boxes[i], 1);
    }
    if (belong_together(common, areas)) {
        references[0] = make(common, first, 4);
        return 1;
    }
    size_t made = make_pair(boxes, first, references);
    return made + make_pair(boxes + 2, first + 2, references + made);
}

size_t glint_references_make(const glint_bvh_inputs *in, size_t first, size_t count,
                             glint_reference *references)
{
    const size_t last = first + count;
    size_t made = 0;
    for (size_t i = first; i < last; i += GLINT_BUNDLE_MAX) {
        const size_t own = last - i < GLINT_BUNDLE_MAX ? last - i : GLINT_BUNDLE_MAX;
        bool kept[GLINT_BUNDLE_MAX], all = own == GLINT_BUNDLE_MAX;
        for (size_t k = 0; k < own; k++) {
            kept[k] = glint_bvh_has_area(in, i + k);
            all = all && kept[k];
        }
        if (all) {
            made += make_four(in, i, references + made);
            continue;
        }
        for (size_t k = 0; k < own; k++) {
            if (kept[k]) {
                references[made++] = make(triangle_box(in, i + k), i + k, 1);
            }
        }
    }
    return made;
}

void glint_references_unbundle(const glint_bvh_inputs *in, const glint_reference *bundles,
                               size_t bundle_count, glint_reference *references)
{
    for (size_t i = 0; i < bundle_count; i++) {
        const size_t first = glint_reference_first(bundles[i]);
        const size_t count = glint_reference_count(bundles[i]);
        for (size_t k = 0; k < count; k++) {
            *references++ = make(triangle_box(in, first + k), first + k, 1);
        }
    }
}
