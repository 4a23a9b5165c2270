// Builds one thread's part of the tree. See range.h.
#include "accel/range.h"

#include "accel/treelet.h"
#include "base/memory.h"

#include <stdlib.h>

// Sets the bounds of the references and of their middles; counts the triangles.
static void measure(glint_range *range)
{
    range->triangle_count = 0;
    range->node->bounds = range->middles = glint_box_empty();
    for (size_t i = 0; i < range->count; i++) {
        const glint_reference reference = range->references[i];
        range->node->bounds = glint_box_union(range->node->bounds, reference);
        range->middles = glint_box_union(range->middles, glint_box_of(glint_box_middle(reference)));
        range->triangle_count += glint_reference_count(reference);
    }
}

void glint_range_halve(const glint_range *range, glint_binary_node children[2],
                       glint_range halves[2])
{
    const size_t left = range->count / 2;
    for (int side = 0; side < 2; side++) {
        const size_t first = side == 0 ? 0 : left;
        halves[side] = (glint_range){
            .node = &children[side],
            .references = range->references + first,
            .spare = range->spare + first,
            .count = side == 0 ? left : range->count - left,
            .depth = range->depth + 1,
        };
        measure(&halves[side]);
    }
}

void glint_range_divide(const glint_range *range, const glint_split *split,
                        const glint_box middles[2], glint_binary_node children[2],
                        glint_range sides[2])
{
    for (int side = 0; side < 2; side++) {
        const size_t first = side == 0 ? 0 : split->references[0];
        children[side].bounds = split->bounds[side];
        sides[side] = (glint_range){
            .node = &children[side],
            .references = range->spare + first,
            .spare = range->references + first,
            .count = split->references[side],
            .triangle_count = split->triangles[side],
            .middles = middles[side],
            .depth = range->depth + 1,
        };
    }
}

// The working memory of one thread.
typedef struct worker {
    const glint_bvh_inputs *in;
    glint_arena *arena;
    glint_bins *bins;                    // bins of the range that is being divided
    glint_reference *references, *spare; // [GLINT_BUNDLED_MIN]: the range unbundled last
} worker;

static void split_range(const worker *w, const glint_range *range, glint_binary_node children[2],
                        glint_range sides[2])
{
    glint_split split;
    const glint_binning binning = glint_binning_of(range->middles);
    glint_bins_fill(w->bins, &binning, range->references, range->count);
    if (range->depth >= GLINT_SAH_DEPTH_LIMIT ||
        !glint_split_find(w->bins, range->node->bounds, &split)) {
        glint_range_halve(range, children, sides);
        return;
    }
    glint_split_sides to = {{range->spare, range->spare + split.references[0]},
                            {glint_box_empty(), glint_box_empty()}};
    glint_split_apply(&split, &binning, range->references, range->count, &to);
    glint_range_divide(range, &split, to.middles, children, sides);
}

// Makes single references of a range: one for each triangle.
static glint_range unbundle(const worker *w, const glint_range *range)
{
    glint_range single = *range;
    single.references = w->references;
    single.spare = w->spare;
    single.count = range->triangle_count;
    glint_references_unbundle(w->in, range->references, range->count, w->references);
    measure(&single);
    return single;
}

static bool build(const worker *w, const glint_range *range, bool bundled, glint_wide_costs *costs)
{
    if (bundled && range->triangle_count <= GLINT_BUNDLED_MIN) {
        const glint_range single = unbundle(w, range);
        return build(w, &single, false, costs);
    }
    if (!bundled && range->count <= GLINT_TREELET_MAX) {
        const glint_treelet_range treelet = {range->references, range->count, range->node};
        return glint_treelet_build(w->in, &treelet, w->arena, costs);
    }
    glint_binary_node *children = glint_arena_take(w->arena, 2 * sizeof *children);
    if (children == NULL) {
        return false;
    }
    glint_range sides[2];
    split_range(w, range, children, sides);
    range->node->children = children;
    glint_wide_costs left, right;
    if (!build(w, &sides[0], bundled, &left) || !build(w, &sides[1], bundled, &right)) {
        return false;
    }
    *costs = glint_wide_costs_join(range->node, w->in->width, &left, &right);
    return true;
}

bool glint_range_build(const glint_bvh_inputs *in, const glint_range *range, glint_arena *arena,
                       glint_wide_costs *costs)
{
    glint_bins bins;
    const worker w = {
        .in = in,
        .arena = arena,
        .bins = &bins,
        .references = glint_allocate_unset(GLINT_BUNDLED_MIN, sizeof *w.references),
        .spare = glint_allocate_unset(GLINT_BUNDLED_MIN, sizeof *w.spare),
    };
    bool built = w.references != NULL && w.spare != NULL && build(&w, range, true, costs);
    free(w.references);
    free(w.spare);
    return built;
}
