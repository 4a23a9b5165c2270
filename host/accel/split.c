// Bins references, chooses a split and applies it. See split.h.
#include "accel/split.h"

#include "accel/cluster.h"

float glint_bin_scale(float extent, int bins)
{
    // Slightly less, so that rounding does not give one bin more.
    float scale = (float)bins * (1 - 0x1p-20f) / extent;
    return extent > 0 && isfinite(scale) ? scale : 0;
}

glint_binning glint_binning_of(glint_box middles)
{
    glint_binning binning = {.low = -middles.low_negated};
    for (int axis = 0; axis < 3; axis++) {
        float extent = middles.high[axis] + middles.low_negated[axis];
        binning.scale[axis] = glint_bin_scale(extent, GLINT_BINS);
    }
    return binning;
}

static inline glint_int4 bins_of(const glint_binning *binning, glint_reference reference)
{
    glint_float4 position = (glint_box_middle(reference) - binning->low) * binning->scale;
    return __builtin_convertvector(position, glint_int4);
}

static void clear(glint_bins *bins)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < GLINT_BINS; i++) {
            bins->axes[axis][i] = (glint_bin){.box = glint_box_empty()};
        }
    }
}

static inline void add_to_bin(glint_bin *bin, glint_reference reference, uint32_t triangles)
{
    bin->box = glint_box_union(bin->box, reference);
    bin->references++;
    bin->triangles += triangles;
}

void glint_bins_merge(glint_bins *bins, const glint_bins *more)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < GLINT_BINS; i++) {
            glint_bin *bin = &bins->axes[axis][i];
            bin->box = glint_box_union(bin->box, more->axes[axis][i].box);
            bin->references += more->axes[axis][i].references;
            bin->triangles += more->axes[axis][i].triangles;
        }
    }
}

static inline void add_reference(glint_bins *bins, const glint_binning *binning,
                                 glint_reference reference)
{
    const glint_int4 bin = bins_of(binning, reference);
    const uint32_t triangles = glint_reference_count(reference);
    add_to_bin(&bins->axes[0][(uint32_t)bin[0]], reference, triangles);
    add_to_bin(&bins->axes[1][(uint32_t)bin[1]], reference, triangles);
    add_to_bin(&bins->axes[2][(uint32_t)bin[2]], reference, triangles);
}

void glint_bins_fill(glint_bins *bins, const glint_binning *binning,
                     const glint_reference *references, size_t count)
{
    // Add every other reference to a second set of bins. Neighbours often fall into the same bin,
    // where each addition would wait for the store of the one before.
    glint_bins others;
    clear(bins);
    clear(&others);
    for (size_t i = 0; i + 1 < count; i += 2) {
        add_reference(bins, binning, references[i]);
        add_reference(&others, binning, references[i + 1]);
    }
    if (count % 2 > 0) {
        add_reference(bins, binning, references[count - 1]);
    }
    glint_bins_merge(bins, &others);
}

size_t glint_bins_left_count(const glint_bins *bins, const glint_split *split)
{
    size_t count = 0;
    for (int i = 0; i < split->bin; i++) {
        count += bins->axes[split->axis][i].references;
    }
    return count;
}

// Sets split->axis and split->bin if this axis has a cheaper split than *cost.
static void sweep_axis(const glint_bins *bins, int axis, float scale, float *cost,
                       glint_split *split)
{
    const glint_bin *bin = bins->axes[axis];
    float right_cost[GLINT_BINS];
    glint_box right = glint_box_empty();
    uint32_t right_count = 0;
    for (int i = GLINT_BINS - 1; i > 0; i--) {
        right = glint_box_union(right, bin[i].box);
        right_count += bin[i].triangles;
        right_cost[i] =
            right_count > 0
                ? glint_cluster_cost(right, scale, (float)glint_clusters_expected(right_count))
                : INFINITY;
    }
    glint_box left = glint_box_empty();
    uint32_t left_count = 0;
    for (int i = 1; i < GLINT_BINS; i++) {
        left = glint_box_union(left, bin[i - 1].box);
        left_count += bin[i - 1].triangles;
        if (left_count == 0) {
            continue;
        }
        float both = glint_cluster_cost(left, scale, (float)glint_clusters_expected(left_count)) +
                     right_cost[i];
        if (both < *cost) {
            *cost = both;
            split->axis = axis;
            split->bin = i;
        }
    }
}

static void add_up(const glint_bin *bins, int first, int last, glint_split *split, int side)
{
    split->bounds[side] = glint_box_empty();
    split->references[side] = split->triangles[side] = 0;
    for (int i = first; i < last; i++) {
        split->bounds[side] = glint_box_union(split->bounds[side], bins[i].box);
        split->references[side] += bins[i].references;
        split->triangles[side] += bins[i].triangles;
    }
}

bool glint_split_find(const glint_bins *bins, glint_box bounds, glint_split *split)
{
    const float scale = glint_box_scale(bounds);
    float cost = INFINITY;
    split->axis = -1;
    for (int axis = 0; axis < 3; axis++) {
        sweep_axis(bins, axis, scale, &cost, split);
    }
    if (split->axis < 0) {
        return false;
    }
    add_up(bins->axes[split->axis], 0, split->bin, split, 0);
    add_up(bins->axes[split->axis], split->bin, GLINT_BINS, split, 1);
    return true;
}

void glint_split_apply(const glint_split *split, const glint_binning *binning,
                       const glint_reference *references, size_t count, glint_split_sides *sides)
{
    glint_split_sides next = *sides;
    for (size_t i = 0; i < count; i++) {
        const glint_reference reference = references[i];
        // No branch: the side cannot be predicted.
        const int side = bins_of(binning, reference)[split->axis] >= split->bin;
        next.middles[side] =
            glint_box_union(next.middles[side], glint_box_of(glint_box_middle(reference)));
        *next.references[side]++ = reference;
    }
    sides->middles[0] = next.middles[0];
    sides->middles[1] = next.middles[1];
}
