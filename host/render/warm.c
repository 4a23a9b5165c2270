// Compiles kernels without a scene. See general.h.
#include "base/clock.h"
#include "render/kernels.h"
#include "render/plan_parts.h"

#include <stdlib.h>
#include <string.h>

// The part of a plan that general kernels depend on, as frames with default settings have it.
static glint_status make_plan(const glint_device *device, const glint_general_request *request,
                              glint_plan *plan, glint_error *error)
{
    static const uint32_t pixel = 0;
    glint_settings settings = glint_settings_default;
    settings.precision = request->precision;
    const glint_scene nothing = {0};
    const glint_capabilities *capabilities = glint_device_capabilities(device);
    TRY(glint_settings_check(&settings, capabilities, &nothing, error));
    settings.list = request->for_lists ? &pixel : NULL; // the plan asks only if there is one
    *plan = (glint_plan){.precision = request->precision,
                         .traversal_stack = GLINT_TRAVERSAL_STACK_LEAST};
    const glint_plan_inputs inputs = {
        .scene = &nothing, .device = capabilities, .settings = &settings};
    glint_plan_choose_packets(&inputs, plan);
    return GLINT_OK;
}

glint_status glint_general_compile(glint_device *device, const glint_general_request *request,
                                   glint_general_report *report, glint_error *error)
{
    double clock = glint_now_ms();
    glint_plan plan;
    *report = (glint_general_report){0};
    TRY(make_plan(device, request, &plan, error));
    char options[4096];
    glint_kernel_options(&plan, request->kind, options, sizeof options);
    const glint_kernel_request kernels = {.device = device, .plan = &plan};
    TRY(glint_kernels_compile(&kernels, options, &report->was_compiled, error));
    report->ms = glint_lap_ms(&clock);
    return GLINT_OK;
}

glint_status glint_special_compile(glint_device *device, const char *options,
                                   glint_general_report *report, glint_error *error)
{
    static const char width[] = "-DGLINT_WIDTH=";
    double clock = glint_now_ms();
    const char *at = strstr(options, width);
    *report = (glint_general_report){0};
    if (at == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--build-options: no %s is among them (glint info --json lists a plan's "
                          "build_options)",
                          width);
    }
    const glint_plan plan = {.kernel_width = atoi(at + strlen(width))};
    const glint_kernel_request kernels = {.device = device, .plan = &plan};
    TRY(glint_kernels_compile(&kernels, options, &report->was_compiled, error));
    report->ms = glint_lap_ms(&clock);
    return GLINT_OK;
}
