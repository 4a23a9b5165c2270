// Loads scenes ahead on a thread. See ahead.h.
#include "cli/render/ahead.h"

#include "base/clock.h"

glint_status render_pose_load(const glint_input_request *request, glint_scene_source *source,
                              render_pose *pose, glint_error *error)
{
    const double begun = glint_now_ms();
    glint_status status = glint_scene_at(source, pose->time, &pose->scene, NULL, error);
    if (status == GLINT_OK) {
        status = glint_inputs_stage(request, source, &pose->scene, &pose->viewpoint, error);
    }
    if (status == GLINT_OK) {
        status = glint_fingerprint_scene(&pose->scene, &pose->is, error);
    }
    if (status != GLINT_OK) {
        glint_scene_free(&pose->scene);
    }
    pose->is_loaded = status == GLINT_OK;
    pose->ms = glint_now_ms() - begun;
    return status;
}

static void *look_ahead(void *context)
{
    render_ahead *ahead = context;
    render_pose *pose = &ahead->pose;
    const double begun = glint_now_ms();
    glint_error error = {0};
    glint_status status = render_pose_load(ahead->request, ahead->source, pose, &error);
    if (status == GLINT_OK && ahead->with_tree &&
        !glint_fingerprints_equal(pose->is, ahead->shown)) {
        status = glint_renderer_prepare(ahead->renderer, &pose->scene, &error);
        pose->is_prepared = status == GLINT_OK;
    }
    glint_error_free(&error);
    pose->ms = glint_now_ms() - begun;
    return NULL;
}

void render_ahead_begin(render_ahead *ahead, double time)
{
    if (ahead->is_under_way) {
        return;
    }
    ahead->pose = (render_pose){.time = time};
    ahead->is_under_way = pthread_create(&ahead->thread, NULL, look_ahead, ahead) == 0;
}

bool render_ahead_take(render_ahead *ahead, double time, render_pose *pose)
{
    if (!ahead->is_under_way) {
        return false;
    }
    pthread_join(ahead->thread, NULL);
    ahead->is_under_way = false;
    if (!ahead->pose.is_loaded || ahead->pose.time != time) {
        glint_scene_free(&ahead->pose.scene);
        return false;
    }
    *pose = ahead->pose;
    return true;
}
