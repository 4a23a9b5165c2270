// Writes plans as build options and as text. See plan.h.
#include "render/plan.h"

#include <stdio.h>

const char *glint_feature_name(glint_feature feature)
{
    static const char *const names[] = {
#define NAME(name, ...) #name,
        GLINT_FEATURES(NAME)
#undef NAME
    };
    return names[feature];
}

const char *glint_feature_meaning(glint_feature feature)
{
    static const char *const meanings[] = {
#define MEANING(name, meaning, ...) meaning,
        GLINT_FEATURES(MEANING)
#undef MEANING
    };
    return meanings[feature];
}

int glint_plan_feature_count(const glint_plan *plan)
{
    int count = 0;
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        count += plan->features[i].compiled;
    }
    return count;
}

void glint_plan_write_options(const glint_plan *plan, const glint_variant *variant,
                              char text[GLINT_BUILD_OPTIONS_BYTES])
{
    const size_t capacity = GLINT_BUILD_OPTIONS_BYTES;
    size_t used = (size_t)snprintf(
        text, capacity,
        "-cl-std=CL1.2 -w -DGLINT_GENERAL=%d -DGLINT_WIDTH=%d -DGLINT_BVH_WIDTH=%d "
        "-DGLINT_DOUBLE=%d -DGLINT_HALF_TEXELS=%d -DGLINT_STACK_CAPACITY=%d "
        "-DGLINT_TRAVERSAL_STACK=%d -DGLINT_TILES=%d",
        variant->is_general, plan->kernel_width, plan->bvh_width,
        plan->precision == GLINT_PRECISION_DOUBLE, variant->half_texels, variant->stack_capacity,
        variant->traversal_stack, plan->tiles);
    for (int i = 0; i < GLINT_FEATURE_COUNT && used < capacity; i++) {
        used += (size_t)snprintf(text + used, capacity - used, " -DGLINT_%s=%d",
                                 glint_feature_name((glint_feature)i), variant->features[i]);
    }
    if (plan->build_tag != 0 && used < capacity) {
        snprintf(text + used, capacity - used, " -DGLINT_BUILD_TAG=%u", plan->build_tag);
    }
}

void glint_plan_build_options(const glint_plan *plan, char text[GLINT_BUILD_OPTIONS_BYTES])
{
    glint_variant own = {.half_texels = plan->half_texels,
                         .stack_capacity = plan->stack_capacity,
                         .traversal_stack = plan->traversal_stack};
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        own.features[i] = plan->features[i].compiled;
    }
    glint_plan_write_options(plan, &own, text);
}

void glint_plan_describe(const glint_plan *plan, char *text, size_t capacity)
{
    char depth[32];
    snprintf(depth, sizeof depth,
             plan->depth_is_exact  ? "auto (%d is exact)"
             : plan->depth_is_auto ? "auto (at most %d)"
                                   : "%d",
             plan->depth);
    snprintf(
        text, capacity,
        "shading %s, depth %s, precision %s, %s texels, filter %s, width %d, %d of %d features",
        glint_shading_name(plan->shading), depth,
        plan->precision == GLINT_PRECISION_DOUBLE ? "double" : "float",
        plan->half_texels ? "half" : "float",
        plan->features[GLINT_FEATURE_MIP_LEVELS].compiled ? "mip" : "bilinear", plan->kernel_width,
        glint_plan_feature_count(plan), GLINT_FEATURE_COUNT);
}
