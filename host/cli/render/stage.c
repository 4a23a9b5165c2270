// Moves scene and camera to a frame's time. See stage.h.
#include "cli/render/stage.h"

#include <stdlib.h>
#include <string.h>

// Copies the camera's name, because it must outlive the scene.
static void keep_camera_name(render_stage *stage)
{
    const char *name = stage->inputs.viewpoint.camera.name;
    if (stage->camera_name == NULL && name != NULL) {
        stage->camera_name = strdup(name);
    }
}

glint_status render_stage_load(render_stage *stage, const render_request *request,
                               glint_progress_display *display, glint_error *error)
{
    glint_input_request of_scene = request->inputs;
    of_scene.camera_may_wait = true;
    stage->request = request;
    TRY(glint_inputs_load_scene(&of_scene, display, &stage->inputs, error));
    TRY(glint_fingerprint_scene(&stage->inputs.scene, &stage->is, error));
    const char *path = stage->inputs.scene.path;
    stage->path = path != NULL ? strdup(path) : NULL;
    stage->stands = !stage->inputs.viewpoint.camera.is_lost; // the scene is at time 0
    keep_camera_name(stage);
    return GLINT_OK;
}

// Replaces the scene by the scene at `time`, which may have been loaded ahead.
static glint_status take_pose(render_stage *stage, double time, glint_error *error)
{
    glint_inputs *inputs = &stage->inputs;
    render_pose pose = {.time = time};
    if (!render_ahead_take(&stage->ahead, time, &pose)) {
        TRY(render_pose_load(&stage->request->inputs, inputs->source, &pose, error));
    }
    glint_scene_free(&inputs->scene);
    inputs->scene = pose.scene;
    inputs->viewpoint = pose.viewpoint;
    stage->is = pose.is;
    stage->is_prepared = pose.is_prepared;
    stage->loading_ms = pose.ms;
    return GLINT_OK;
}

static glint_status move_to(render_stage *stage, double time, glint_error *error)
{
    glint_inputs *inputs = &stage->inputs;
    if (glint_motion_moves_scene(&inputs->motion)) {
        return take_pose(stage, time, error);
    }
    if (inputs->motion.moves_cameras) {
        TRY(glint_scene_cameras_at(inputs->source, time, &inputs->scene, error));
        return glint_viewpoint_find(&stage->request->inputs.view, &inputs->scene,
                                    &inputs->viewpoint, error);
    }
    return GLINT_OK;
}

glint_status render_stage_set(render_stage *stage, int frame, glint_error *error)
{
    const double time = render_request_time(stage->request, frame);
    stage->loading_ms = 0;
    if (stage->inputs.source == NULL || (stage->stands && time == stage->time)) {
        return GLINT_OK;
    }
    stage->stands = false;
    stage->time = time;
    TRY(move_to(stage, time, error));
    stage->stands = true;
    keep_camera_name(stage);
    return GLINT_OK;
}

glint_camera render_stage_camera(const render_stage *stage, int frame)
{
    const glint_viewpoint *viewpoint = &stage->inputs.viewpoint;
    const int turntable = stage->request->turntable;
    glint_camera camera = viewpoint->camera;
    camera.name = stage->camera_name;
    return turntable == 0
               ? camera
               : glint_camera_orbit(&camera, viewpoint->centre, (int64_t)frame - 1, turntable);
}

void render_stage_free(render_stage *stage)
{
    render_pose unused = {0};
    if (render_ahead_take(&stage->ahead, stage->ahead.pose.time, &unused)) {
        glint_scene_free(&unused.scene);
    }
    glint_inputs_free(&stage->inputs);
    free(stage->path);
    free(stage->camera_name);
    *stage = (render_stage){0};
}
