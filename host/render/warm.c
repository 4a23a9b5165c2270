// Compiles general kernels without a scene. See general.h.
#include "base/clock.h"
#include "render/kernels.h"
#include "render/plan_parts.h"

// The part of a plan that general kernels depend on, as frames with default settings have it.
static glint_status make_plan(const glint_device *device, glint_precision precision,
                              glint_plan *plan, glint_error *error)
{
    glint_settings settings = glint_settings_default;
    settings.precision = precision;
    const glint_scene nothing = {0};
    const glint_capabilities *capabilities = glint_device_capabilities(device);
    TRY(glint_settings_check(&settings, capabilities, &nothing, error));
    *plan = (glint_plan){.precision = precision, .traversal_stack = GLINT_TRAVERSAL_STACK_LEAST};
    const glint_plan_inputs inputs = {
        .scene = &nothing, .device = capabilities, .settings = &settings};
    glint_plan_choose_packets(&inputs, plan);
    return GLINT_OK;
}

glint_status glint_general_compile(glint_device *device, glint_kernel_kind kind,
                                   glint_precision precision, glint_general_report *report,
                                   glint_error *error)
{
    double clock = glint_now_ms();
    glint_plan plan;
    *report = (glint_general_report){0};
    TRY(make_plan(device, precision, &plan, error));
    const glint_kernel_request request = {.device = device, .plan = &plan};
    TRY(glint_kernels_compile(&request, kind, &report->was_compiled, error));
    report->ms = glint_lap_ms(&clock);
    return GLINT_OK;
}
