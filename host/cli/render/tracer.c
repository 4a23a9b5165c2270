// Opens the device and updates the renderer of a run. See tracer.h.
#include "cli/render/tracer.h"

static glint_status open_device(render_tracer *tracer, const render_request *request,
                                glint_error *error)
{
    TRY(glint_device_open(request->inputs.device, &tracer->device, error));
    if (request->max_error == 0) {
        return GLINT_OK;
    }
    glint_error_bound_begin(&tracer->bound, request->max_error, &request->inputs.settings);
    const glint_capabilities *device = glint_device_capabilities(tracer->device);
    return device->has_double
               ? GLINT_OK
               : glint_fail(error, GLINT_DEVICE_LACKS,
                            "--max-error: device '%s' has no double precision, which errors are "
                            "counted from (name another with --device)",
                            device->name);
}

// Makes the shot's environment and tells `bound` about it.
static glint_status make_light(render_tracer *tracer, render_shot *shot, glint_error *error)
{
    TRY(render_light_make(&shot->light, &shot->stage, tracer->device, error));
    const glint_fingerprint light = shot->light.loaded;
    if (shot->request->max_error > 0 && !glint_fingerprints_equal(tracer->weighed_light, light)) {
        glint_error_bound_set_environment(&tracer->bound, &shot->stage.inputs.environment.radiance);
        tracer->weighed_light = light;
    }
    return GLINT_OK;
}

glint_status render_tracer_begin(render_tracer *tracer, render_shot *shot, glint_error *error)
{
    const render_request *request = shot->request;
    if (tracer->device == NULL) {
        TRY(open_device(tracer, request, error));
    }
    TRY(make_light(tracer, shot, error));
    glint_progress_phase(shot->display, "prepare", "building the tree and the kernels");
    const glint_renderer_inputs inputs = {
        .device = tracer->device,
        .scene = &shot->stage.inputs.scene,
        .environment = &shot->stage.inputs.environment,
        .settings = &request->inputs.settings,
        .kernel_dir = request->inputs.kernel_dir,
    };
    tracer->scene = shot->stage.is;
    tracer->light = shot->light.loaded;
    tracer->tree = "built";
    return glint_renderer_create(&inputs, &tracer->renderer, error);
}

static glint_status show_scene(render_tracer *tracer, render_stage *stage, glint_error *error)
{
    const glint_scene *scene = &stage->inputs.scene;
    if (glint_fingerprints_equal(stage->is, tracer->scene)) {
        return GLINT_OK;
    }
    const bool is_prepared = stage->is_prepared;
    stage->is_prepared = false;
    tracer->scene = (glint_fingerprint){0};
    TRY(is_prepared ? glint_renderer_set_prepared(tracer->renderer, scene, error)
                    : glint_renderer_set_scene(tracer->renderer, scene, error));
    tracer->scene = stage->is;
    tracer->tree = glint_renderer_bvh(tracer->renderer)->is_refitted ? "fitted" : "built";
    return GLINT_OK;
}

glint_status render_tracer_show(render_tracer *tracer, render_shot *shot, glint_error *error)
{
    TRY(show_scene(tracer, &shot->stage, error));
    TRY(make_light(tracer, shot, error));
    if (!glint_fingerprints_equal(tracer->light, shot->light.loaded)) {
        tracer->light = (glint_fingerprint){0};
        TRY(glint_renderer_set_environment(tracer->renderer, &shot->stage.inputs.environment,
                                           error));
        tracer->light = shot->light.loaded;
    }
    return GLINT_OK;
}

void render_tracer_look_ahead(render_tracer *tracer, render_shot *shot, int next, bool may_skip)
{
    const render_request *request = shot->request;
    render_stage *stage = &shot->stage;
    const double time = render_request_time(request, next);
    if (!glint_motion_moves_scene(&stage->inputs.motion) || time == stage->time) {
        return;
    }
    stage->ahead.request = &request->inputs;
    stage->ahead.source = stage->inputs.source;
    stage->ahead.renderer = tracer->renderer;
    stage->ahead.shown = tracer->scene;
    // Do not prepare the renderer if the environment may change: this may change the plan.
    stage->ahead.with_tree = request->env_name.length == 0 && request->capture == NULL && !may_skip;
    render_ahead_begin(&stage->ahead, time);
}

glint_subject render_tracer_subject(const render_tracer *tracer, const render_shot *shot)
{
    const glint_inputs *inputs = &shot->stage.inputs;
    return (glint_subject){
        .scene = &inputs->scene,
        .overrides = &shot->request->inputs.overrides,
        .environment = &inputs->environment,
        .camera = &inputs->viewpoint.camera,
        .settings = &shot->request->inputs.settings,
        .max_error = shot->request->max_error,
        .device = glint_device_capabilities(tracer->device),
        .plan = glint_renderer_plan(tracer->renderer),
        .kernels = glint_kernel_kind_name(glint_renderer_kernels(tracer->renderer)),
        .bvh = glint_renderer_bvh(tracer->renderer),
        .warnings = &inputs->warnings,
    };
}

void render_tracer_free(render_tracer *tracer)
{
    glint_renderer_free(tracer->renderer);
    glint_device_close(tracer->device);
    *tracer = (render_tracer){0};
}
