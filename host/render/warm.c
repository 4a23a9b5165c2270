// Compiles kernels without a scene. See general.h.
#include "base/clock.h"
#include "render/kernels.h"
#include "render/plan_device.h"

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

static glint_status compile(glint_device *device, const glint_plan *plan, const char *options,
                            glint_compile_report *report, glint_error *error)
{
    double clock = glint_now_ms();
    const glint_kernel_request kernels = {.device = device, .plan = plan};
    TRY(glint_kernels_compile(&kernels, options, &report->was_cached, error));
    report->ms = glint_lap_ms(&clock);
    return GLINT_OK;
}

glint_status glint_general_compile(glint_device *device, const glint_general_request *request,
                                   glint_compile_report *report, glint_error *error)
{
    glint_plan plan;
    char options[GLINT_BUILD_OPTIONS_BYTES];
    *report = (glint_compile_report){0};
    TRY(make_plan(device, request, &plan, error));
    if (request->for_lists) {
        const glint_general_request whole = {request->kind, request->precision, false};
        glint_plan plan_of_whole;
        TRY(make_plan(device, &whole, &plan_of_whole, error));
        report->is_needless = !plan_of_whole.tiles;
    }
    if (report->is_needless) {
        return GLINT_OK;
    }
    glint_kernel_options(&plan, request->kind, options);
    return compile(device, &plan, options, report, error);
}

glint_status glint_special_compile(glint_device *device, const char *options,
                                   glint_compile_report *report, glint_error *error)
{
    static const char width[] = "-DGLINT_WIDTH=";
    const char *at = strstr(options, width);
    *report = (glint_compile_report){0};
    if (at == NULL) {
        return glint_fail(error, GLINT_USAGE,
                          "--build-options: no %s is among them (glint info --json lists a plan's "
                          "build_options)",
                          width);
    }
    const glint_plan plan = {.kernel_width = atoi(at + strlen(width)),
                             .shading = strstr(options, "-DGLINT_VERTEX_COLOR=1") != NULL
                                            ? GLINT_SHADING_VERTEX_COLOR
                                        : strstr(options, "-DGLINT_VERTEX_DIRECTION=1") != NULL
                                            ? GLINT_SHADING_VERTEX_DIRECTION
                                            : GLINT_SHADING_PIXEL};
    return compile(device, &plan, options, report, error);
}
