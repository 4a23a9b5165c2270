// Makes the plan: what is compiled, and why. See plan_make.h.
#include "render/plan_make.h"

#include "render/layers.h"
#include "render/plan_device.h"
#include "render/plan_features.h"

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
