// Scene, camera and renderer of a run. See render_stage.h.
#include "cli/render/stage.h"

#include "cli/render/parcel.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Takes the scene of a time, loaded ahead or now, in the place of the one that there is.
static glint_status take_pose(render_run *run, double time, glint_error *error)
{
    glint_inputs *inputs = &run->inputs;
    render_pose pose = {.time = time};
    if (!render_ahead_take(&run->ahead, time, &pose)) {
        glint_status status = render_pose_load(&run->request->inputs, inputs->source, &pose, error);
        if (status != GLINT_OK) {
            return status;
        }
    }
    glint_scene_free(&inputs->scene);
    inputs->scene = pose.scene;
    inputs->viewpoint = pose.viewpoint;
    run->scene_is = pose.is;
    run->is_prepared = pose.is_prepared;
    run->build_ms += pose.ms;
    return GLINT_OK;
}

// The name outlives the scene that it is from.
static void keep_camera_name(render_run *run)
{
    const char *name = run->inputs.viewpoint.camera.name;
    if (run->camera_name == NULL && name != NULL) {
        run->camera_name = strdup(name);
    }
}

glint_status render_stage_set(render_run *run, int frame, glint_error *error)
{
    glint_inputs *inputs = &run->inputs;
    const glint_motion *motion = &inputs->motion;
    const double time = render_request_time(run->request, frame);
    glint_status status = GLINT_OK;
    if (inputs->source == NULL || (run->stands && time == run->time)) {
        return GLINT_OK;
    }
    run->stands = false;
    if (motion->moves_triangles) {
        status = take_pose(run, time, error);
    } else if (motion->moves_cameras) {
        status = glint_scene_cameras_at(inputs->source, time, &inputs->scene, error);
        if (status == GLINT_OK) {
            status = glint_scene_camera(&inputs->scene, run->request->inputs.camera,
                                        &inputs->viewpoint.camera, error);
        }
    }
    run->stands = status == GLINT_OK;
    run->time = time;
    if (run->stands) {
        keep_camera_name(run);
    }
    return status;
}

glint_camera render_stage_camera(const render_run *run, int frame)
{
    const glint_viewpoint *viewpoint = &run->inputs.viewpoint;
    glint_camera camera = viewpoint->camera;
    camera.name = run->camera_name;
    return run->request->turntable == 0
               ? camera
               : glint_camera_orbit(&camera, viewpoint->centre, (int64_t)frame - 1,
                                    run->request->turntable);
}

void render_stage_fingerprint(const render_run *run, const glint_camera *camera,
                              char text[GLINT_FINGERPRINT_TEXT])
{
    const glint_fingerprint parts[] = {run->fingerprint, run->scene_is, run->light.is,
                                       run->plate_is};
    glint_fingerprint_frame(parts, sizeof parts / sizeof *parts, camera, text);
}

glint_status render_stage_show(render_run *run, glint_error *error)
{
    if (glint_fingerprints_equal(run->scene_is, run->renderer_shows)) {
        return GLINT_OK;
    }
    const glint_scene *scene = &run->inputs.scene;
    glint_status status = run->is_prepared
                              ? glint_renderer_set_prepared(run->renderer, scene, error)
                              : glint_renderer_set_scene(run->renderer, scene, error);
    run->is_prepared = false;
    run->renderer_shows = status == GLINT_OK ? run->scene_is : (glint_fingerprint){0};
    run->tree = glint_renderer_bvh(run->renderer)->is_refitted ? "fitted" : "built";
    return status;
}

glint_status render_run_load(render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    glint_input_request inputs = request->inputs;
    inputs.camera_may_wait = true;
    glint_status status = glint_inputs_load_scene(&inputs, &run->display, &run->inputs, error);
    if (status == GLINT_OK) {
        status = render_light_load(run, error);
    }
    if (status == GLINT_OK) {
        status = glint_fingerprint_scene(&run->inputs.scene, &run->scene_is, error);
    }
    if (status == GLINT_OK) {
        run->label.path = run->inputs.scene.path != NULL ? strdup(run->inputs.scene.path) : NULL;
        run->stands = !run->inputs.viewpoint.camera.is_lost; // at time 0
        keep_camera_name(run);
    }
    return status;
}

static glint_status open_device(render_run *run, glint_error *error)
{
    const glint_input_request *request = &run->request->inputs;
    glint_status status = glint_device_open(request->device, &run->device, error);
    if (status != GLINT_OK || run->request->max_error == 0) {
        return status;
    }
    glint_error_bound_begin(&run->bound, run->request->max_error, &request->settings);
    const glint_capabilities *device = glint_device_capabilities(run->device);
    return device->has_double
               ? GLINT_OK
               : glint_fail(error, GLINT_DEVICE_FAILED,
                            "--max-error: device '%s' has no double precision, which errors are "
                            "counted from (name another with --device)",
                            device->name);
}

// The renderer of the scene as a frame shows it, in that frame's light.
static glint_status begin_with(render_run *run, int frame, glint_error *error)
{
    const glint_input_request *request = &run->request->inputs;
    glint_status status = render_stage_set(run, frame, error);
    if (status == GLINT_OK) {
        status = render_light_set(run, frame, error);
    }
    if (status == GLINT_OK) {
        status = render_parcel_check_plate(run, frame, error);
    }
    if (status == GLINT_OK && run->device == NULL) {
        status = open_device(run, error);
    }
    if (status == GLINT_OK) {
        status = render_light_show(run, error);
    }
    if (status != GLINT_OK) {
        return status;
    }
    glint_progress_phase(&run->display, "prepare", "building the tree and the kernels");
    const glint_renderer_inputs inputs = {
        .device = run->device,
        .scene = &run->inputs.scene,
        .environment = &run->inputs.environment,
        .settings = &request->settings,
        .kernel_dir = request->kernel_dir,
    };
    run->renderer_shows = run->scene_is;
    run->tree = "built";
    return glint_renderer_create(&inputs, &run->renderer, error);
}

// Whether the next frame may fare better: its scene, its plate and its environment may be good
// ones.
static bool is_one_frames(const render_run *run, glint_status status)
{
    const bool has_own_light = run->request->env_name.length > 0 || run->request->capture != NULL;
    return status == GLINT_BAD_INPUT || (status == GLINT_USAGE && has_own_light);
}

glint_status render_run_prepare(render_run *run, glint_error *error)
{
    run->cursor = (glint_frame_cursor){.list = &run->request->frames, .shard = run->request->shard};
    glint_frame_cursor first = run->cursor;
    glint_error first_error = {0};
    glint_status status = GLINT_OK;
    int frame;
    // What is bad of one frame makes one bad frame, and next_frame says so: the renderer begins
    // with the first that is good. Where none is, the first says why.
    while (glint_frame_next(&first, &frame)) {
        status = begin_with(run, frame, error);
        if (!is_one_frames(run, status)) {
            break;
        }
        if (first_error.code == GLINT_OK) {
            first_error = *error;
        } else {
            glint_error_free(error);
        }
        *error = (glint_error){0};
    }
    if (is_one_frames(run, status)) {
        *error = first_error;
        return first_error.code;
    }
    glint_error_free(&first_error);
    return status;
}

void render_stage_look_ahead(render_run *run)
{
    const render_request *request = run->request;
    glint_frame_cursor after = run->cursor;
    int frame;
    if (!run->inputs.motion.moves_triangles || !glint_frame_next(&after, &frame) ||
        render_request_time(request, frame) == run->time) {
        return;
    }
    char *path = glint_frame_name_make(&request->name, frame);
    run->ahead.request = &request->inputs;
    run->ahead.source = run->inputs.source;
    run->ahead.renderer = run->renderer;
    run->ahead.shown = run->renderer_shows;
    // Another environment may change the plan.
    run->ahead.with_tree = request->env_name.length == 0 && request->capture == NULL &&
                           (!request->skip_existing || (path != NULL && access(path, F_OK) != 0));
    render_ahead_begin(&run->ahead, render_request_time(request, frame));
    free(path);
}
