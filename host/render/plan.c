// Makes the plan: what is compiled, and why. See plan.h.
#include "render/plan.h"

#include "render/layers.h"
#include "render/plan_parts.h"

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

// Layers of paths report truncated light. With a proved depth, they would report light as truncated
// that is exact.
static void choose_sight(const glint_settings *settings, const glint_sight *sight, glint_plan *plan)
{
    plan->sight = (glint_sight){0};
    if (sight != NULL && glint_plan_may_heed_sight(settings)) {
        plan->sight = (settings->aovs & GLINT_AOV_OF_PATHS) == 0
                          ? *sight
                          : (glint_sight){.exits_escape = sight->exits_escape};
    }
}

static void choose_depth(const glint_settings *settings, const glint_sight *sight, glint_plan *plan)
{
    plan->depth_is_auto = settings->depth == 0;
    plan->depth = plan->depth_is_auto ? GLINT_DEPTH_MAX : settings->depth;
    if (settings->output == GLINT_OUTPUT_HITS) {
        plan->depth = 1;
    } else if (glint_plan_shades_vertices(plan)) {
        plan->depth = 1;
        plan->depth_is_auto = false;
    }
    choose_sight(settings, sight, plan);
    plan->depth_is_exact = plan->sight.depth > 0;
    if (plan->depth_is_exact) {
        plan->depth = plan->sight.depth;
    }
}

void glint_plan_heed_sight(glint_plan *plan, bool heed)
{
    if (plan->sight.depth == 0 || plan->depth_is_exact == heed) {
        return;
    }
    plan->depth_is_exact = heed;
    plan->depth = heed ? plan->sight.depth : GLINT_DEPTH_MAX;
    glint_plan_decide_paths(plan);
    glint_plan_describe_secondary_rays(plan);
}

// Decides the part of a plan that depends on neither scene nor topology.
static glint_status vary(const glint_plan_inputs *in, glint_plan *plan, glint_error *error)
{
    const glint_settings *settings = in->settings;
    plan->precision = settings->precision;
    choose_depth(settings, in->sight, plan);
    glint_plan_decide_paths(plan);
    glint_plan_decide_extras(settings, plan);
    if (settings->all_features) {
        glint_plan_compile_idle_features(plan);
    }
    glint_plan_choose_packets(in, plan);
    glint_plan_describe_secondary_rays(plan);
    return glint_plan_choose_texels(in, plan, error);
}

glint_status glint_plan_make(const glint_plan_inputs *in, glint_plan *plan, glint_error *error)
{
    const glint_settings *settings = in->settings;
    *plan = (glint_plan){.build_tag = settings->build_tag,
                         .traversal_stack = GLINT_TRAVERSAL_STACK_LEAST};
    TRY(glint_settings_check(settings, in->device, in->scene, error));
    if (settings->output != GLINT_OUTPUT_HITS && in->scene->triangle_count > 0) {
        plan->shading = settings->shading;
    }
    TRY(glint_plan_decide_features(in, plan, error));
    if (settings->all_features) {
        glint_plan_compile_idle_features(plan); // before the media are chosen, because idle
                                                // features affect them
    }
    glint_plan_choose_media(in, plan);
    return vary(in, plan, error);
}

glint_status glint_plan_vary(const glint_plan_inputs *in, glint_plan *plan, glint_error *error)
{
    TRY(glint_settings_check(in->settings, in->device, in->scene, error));
    return vary(in, plan, error);
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
