// Adapts the kernels to the device: packets, tiles, stacks and texels. See plan_device.h.
#include "render/plan_device.h"

#include "base/half.h"
#include "environment/mip_levels.h"
#include "kernels/layout.h"
#include "kernels/path_state.h"
#include "render/wavelengths.h"

#include <math.h>
#include <stdio.h>

// True if a work-item is one lane of the hardware: on GPUs, and with CPU drivers that fill vectors
// with work-items.
static bool is_lane(const glint_capabilities *device)
{
    return !device->is_cpu || device->native_float_width <= 1;
}

// A packet fills the widest vector of the device, or it is one ray.
int glint_plan_native_width(const glint_capabilities *device, glint_precision precision)
{
    const int per_lane = precision == GLINT_PRECISION_DOUBLE ? 2 : 1;
    return is_lane(device) ? 1 : device->native_float_width / per_lane >= 16 ? 16 : 8;
}

static void choose_width(const glint_plan_inputs *in, glint_plan *plan)
{
    const glint_capabilities *device = in->device;
    const bool is_double = plan->precision == GLINT_PRECISION_DOUBLE;
    const int lanes = device->native_float_width / (is_double ? 2 : 1);
    plan->bvh_width = device->native_float_width >= 16 ? 16 : 8;
    if (in->settings->kernel_width != 0) {
        plan->kernel_width = in->settings->kernel_width;
        snprintf(plan->width_reason, sizeof plan->width_reason, "asked for");
    } else if (is_lane(device)) {
        plan->kernel_width = glint_plan_native_width(device, plan->precision);
        snprintf(plan->width_reason, sizeof plan->width_reason, "%s: one ray a work-item",
                 device->is_cpu ? "the driver makes vectors of work-items" : "not a CPU");
    } else {
        plan->kernel_width = glint_plan_native_width(device, plan->precision);
        snprintf(plan->width_reason, sizeof plan->width_reason,
                 "%sthe device's vectors hold %d %ss", lanes < 8 ? "the narrowest packet; " : "",
                 lanes, is_double ? "double" : "float");
    }
}

// Neighbouring primary rays mostly meet the same nodes and triangles, so a CPU core traces many of
// them together. A GPU needs many small pieces of work.
static void choose_tiles(const glint_settings *settings, glint_plan *plan)
{
    plan->tiles = plan->kernel_width > 1 && settings->list == NULL;
    const char *reason = plan->tiles              ? "primary rays share nodes and triangles"
                         : settings->list != NULL ? "pixels of a list need not be neighbours"
                                                  : "one ray a work-item";
    if (settings->tile_packets != 0 && settings->list == NULL) {
        plan->tiles = settings->tile_packets > 1;
        reason = "asked for";
    }
    snprintf(plan->tiles_reason, sizeof plan->tiles_reason, "%s", reason);
}

// Unused entries of the stack of branches cost nothing. So all least weights down to 2^−16 share
// one kernel (GLINT_STACK_LEAST).
//
// The path continues with the lighter of two branches, which has at most half of the weight. So at
// most 1 + log2(1/min_weight) branches wait. One more entry signals that the stack is nearly full.
static void choose_stack(const glint_settings *settings, glint_plan *plan)
{
    plan->stack_capacity = 0;
    if (!plan->features[GLINT_FEATURE_SPLIT].compiled) {
        snprintf(plan->stack_reason, sizeof plan->stack_reason, "no path splits");
        return;
    }
    double most = plan->features[GLINT_FEATURE_DISPERSION].compiled
                      ? glint_wavelengths_most(settings->wavelengths)
                      : 1;
    double by_weight =
        settings->min_weight > 0 ? floor(log2(most / settings->min_weight)) + 1 : INFINITY;
    double need = fmin(by_weight, plan->depth) + 1;
    plan->stack_capacity = (int)fmax(GLINT_STACK_LEAST, fmin(need, GLINT_DEPTH_MAX + 1));
    if (need > plan->stack_capacity) {
        snprintf(plan->stack_reason, sizeof plan->stack_reason,
                 "%d is the most; more would be truncated and reported", plan->stack_capacity);
    } else {
        snprintf(plan->stack_reason, sizeof plan->stack_reason,
                 "enough for every path of depth %d and least weight %g", plan->depth,
                 settings->min_weight);
    }
}

// The most bytes of the waiting branches of a tile. They lie in a work-item's private memory, which
// on CPUs is a thread's stack. The smallest default of the C library is 2 MiB.
#define LANES_MAX 16
#define BRANCHES_MAX_BYTES ((size_t)5 << 18)

#define TILE_BRANCHES(branch_bytes, width, capacity)                                               \
    ((size_t)(branch_bytes)*16 * (size_t)(width) * (size_t)(capacity))

#define WHOLE_NUMBERS(bytes, number) (((bytes) + (number)-1) / (number) * (number))

// NOLINTNEXTLINE(bugprone-macro-parentheses): a term of a sum
#define BYTES(kind, name, needs, waits, start, meaning) +(waits)*GLINT_BYTES_##kind(sizeof(double))
_Static_assert(TILE_BRANCHES(WHOLE_NUMBERS(GLINT_BRANCH_OWN_BYTES GLINT_PATH_STATE(BYTES),
                                           sizeof(double)),
                             LANES_MAX, GLINT_STACK_LEAST) <= BRANCHES_MAX_BYTES,
               "general kernels, which have all features, have tiles");
#undef BYTES

// The size of a branch that waits (kernels/branches.cl).
static size_t branch_bytes(const glint_plan *plan)
{
    const size_t number = glint_plan_scalar_bytes(plan);
    size_t bytes = GLINT_BRANCH_OWN_BYTES;
#define IS_COMPILED(name) plan->features[GLINT_FEATURE_##name].compiled
#define NEED(name, condition) const bool needs_##name = condition;
    GLINT_PATH_NEEDS(NEED, IS_COMPILED, plan->precision == GLINT_PRECISION_DOUBLE)
#undef NEED
#undef IS_COMPILED
#define ADD(kind, name, needs, waits, start, meaning)                                              \
    bytes += (waits) && needs_##needs ? GLINT_BYTES_##kind(number) : 0;
    GLINT_PATH_STATE(ADD)
#undef ADD
    return WHOLE_NUMBERS(bytes, number);
}

// Each pixel of a tile has room for all branches of a path. If this takes too much memory, a
// work-item renders one packet.
static void limit_branches(glint_plan *plan)
{
    const size_t bytes =
        TILE_BRANCHES(branch_bytes(plan), plan->kernel_width, plan->stack_capacity);
    if (plan->tiles && bytes > BRANCHES_MAX_BYTES) {
        plan->tiles = false;
        snprintf(plan->tiles_reason, sizeof plan->tiles_reason,
                 "the waiting branches of a tile would take %zu KiB", bytes >> 10);
    }
}

void glint_plan_choose_packets(const glint_plan_inputs *in, glint_plan *plan)
{
    choose_width(in, plan);
    choose_tiles(in->settings, plan);
    choose_stack(in->settings, plan);
    limit_branches(plan);
}

// Describes how kernels/traverse_together.cl uses the width and the tiles.
void glint_plan_describe_secondary_rays(glint_plan *plan)
{
    const bool packets = plan->kernel_width > 1;
    snprintf(plan->secondary, sizeof plan->secondary, "%s%s%s", packets ? "packets" : "one by one",
             plan->tiles ? ", together where a tile's run alike" : "",
             packets ? ", in a stream where they spread" : "");
    if (!plan->features[GLINT_FEATURE_INTERREFLECTION].compiled) {
        snprintf(plan->secondary, sizeof plan->secondary, "none");
    }
}

// Chooses the stack of media: the fewest bits per entry that can name every medium. Without
// nesting, one entry is enough.
void glint_plan_choose_media(const glint_plan_inputs *in, glint_plan *plan)
{
    const glint_scene *scene = in->scene;
    int media = 0;
    for (size_t i = 0; i < scene->material_count; i++) {
        media += glint_material_lobes(&scene->materials[i]).solid;
    }
    if (plan->features[GLINT_FEATURE_OVERLAPS].compiled) {
        media = (int)in->solids->medium_count;
    }
    plan->media_count = media;
    int bits = 1;
    while (bits < 30 && (1 << bits) <= media) {
        bits++;
    }
    plan->media_bits = bits;
    bool nested = plan->features[GLINT_FEATURE_NESTED_MEDIA].compiled;
    plan->media_capacity = nested ? 30 / bits : 1;
}

// The largest error that rounding may add to the visible environment (visible_rmse). If all texels
// are as bright as the mean, it is 2.1e-4. A larger error means that some texels are too dark for
// half and lose digits.
#define TEXEL_TOLERANCE 2.5e-4

// Chooses half texels if half can hold the environment, and either half was requested or the error
// is small.
static glint_status weigh_half_texels(const glint_plan_inputs *in, glint_plan *plan,
                                      glint_error *error)
{
    const bool asked_for = in->settings->texels == GLINT_TEXELS_HALF;
    const size_t capacity = sizeof plan->texels_reason;
    // Measure the rounding, if the caller has not done so.
    glint_half_rounding half;
    if (in->half != NULL) {
        half = *in->half;
    } else {
        TRY(glint_half_rounding_measure(in->environment, &half, error));
    }
    // Check the range of half.
    double largest = (double)half.largest, most = (double)GLINT_HALF_MAX;
    bool fits = largest <= most; // false for NaN
    if (!fits && asked_for) {
        return glint_fail(error, GLINT_USAGE,
                          "--texels half: the environment's brightest texel is %g, and half holds "
                          "%g at most (use --texels float)",
                          largest, most);
    }
    if (!fits) {
        snprintf(plan->texels_reason, capacity, "the brightest, %g, is more than half holds (%g)",
                 largest, most);
        return GLINT_OK;
    }
    // Decide by the error.
    plan->half_texels = asked_for || half.visible_rmse <= TEXEL_TOLERANCE;
    snprintf(plan->texels_reason, capacity, "%s an error of %.2g of what is seen (%.2g is allowed)",
             asked_for           ? "asked for; rounding adds"
             : plan->half_texels ? "rounding adds"
                                 : "rounding to half would add",
             half.visible_rmse, TEXEL_TOLERANCE);
    if (plan->half_texels) {
        plan->texels_rmse = half.relative_rmse;
        plan->environment_bytes /= 2;
    }
    return GLINT_OK;
}

// Half texels need half of the memory bandwidth. Double precision, the reference, has them only on
// request.
glint_status glint_plan_choose_texels(const glint_plan_inputs *in, glint_plan *plan,
                                      glint_error *error)
{
    const glint_texels asked = in->settings->texels;
    const char *reason = NULL;
    plan->half_texels = false;
    plan->texels_rmse = 0;
    plan->environment_bytes = sizeof(float) * (glint_plan_reads_levels(plan)
                                                   ? glint_mip_levels_size(in->environment->edge)
                                                   : glint_cube_size(in->environment));
    if (asked == GLINT_TEXELS_FLOAT) {
        reason = "asked for";
    } else if (asked == GLINT_TEXELS_AUTO && plan->precision == GLINT_PRECISION_DOUBLE) {
        reason = "precision double is the reference";
    }
    if (reason == NULL) {
        return weigh_half_texels(in, plan, error);
    }
    snprintf(plan->texels_reason, sizeof plan->texels_reason, "%s", reason);
    return GLINT_OK;
}
