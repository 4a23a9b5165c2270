// Captures environments from the scene. See capture.h.
#include "cli/render/capture.h"

#include "base/clock.h"
#include "cli/common/signals.h"
#include "environment/radiance.h"
#include "render/capture.h"
#include "scene/subset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Loads the whole scene at the stage's time; render_capture_prepare then removes the lit nodes.
static glint_status load_scene(const render_stage *stage, glint_progress_display *display,
                               glint_scene *scene, glint_error *error)
{
    glint_input_request request = stage->request->inputs;
    request.only = NULL;
    request.camera_may_wait = true; // a capture does not look through the camera
    request.view = (glint_view_request){0};
    if (stage->inputs.source != NULL) {
        glint_viewpoint unused;
        TRY(glint_scene_at(stage->inputs.source, stage->time, scene, NULL, error));
        return glint_inputs_stage(&request, stage->inputs.source, scene, &unused, error);
    }
    glint_inputs inputs;
    glint_status status = glint_inputs_load_scene(&request, display, &inputs, error);
    *scene = inputs.scene;
    inputs.scene = (glint_scene){0};
    glint_inputs_free(&inputs);
    return status;
}

static glint_fingerprint fingerprint(const render_capture *capture, const render_request *request)
{
    // The bounds of the proxy follow from the captured scene, which is part of the fingerprint.
    const glint_fingerprint parts[] = {capture->behind_is, capture->scene_is};
    const double *n = request->proxy.numbers;
    char text[400];
    snprintf(text, sizeof text, "capture %d %a %a %a %a %d %a %a %a %a %a %a",
             request->capture_size, capture->at.x, capture->at.y, capture->at.z,
             request->capture_rotate, (int)request->proxy.kind, n[0], n[1], n[2], n[3], n[4], n[5]);
    return glint_fingerprint_join(parts, 2, text);
}

glint_status render_capture_prepare(render_capture *capture, const render_stage *stage,
                                    glint_progress_display *display, glint_fingerprint *is,
                                    glint_error *error)
{
    const render_request *request = stage->request;
    if (!capture->stands || capture->time != stage->time) {
        if (display != NULL) {
            glint_progress_phase(display, "capture", "capturing what is around");
        }
        capture->stands = false;
        glint_scene_free(&capture->scene);
        TRY(load_scene(stage, display, &capture->scene, error));
        TRY(glint_scene_middle_of_nodes(&capture->scene, request->capture, &capture->at, error));
        TRY(glint_scene_remove_nodes(&capture->scene, request->capture, error));
        TRY(glint_fingerprint_scene(&capture->scene, &capture->scene_is, error));
        TRY(proxy_option_make(&request->proxy, capture->at, &capture->scene, &capture->proxy,
                              error));
        capture->time = stage->time;
        capture->stands = true;
    }
    *is = fingerprint(capture, request);
    return GLINT_OK;
}

// Makes the renderer of the six views, if necessary, and gives it the surrounding scene.
static glint_status prepare_renderer(render_capture *capture, const render_request *request,
                                     glint_device *device, glint_error *error)
{
    glint_settings settings =
        glint_capture_settings(&request->inputs.settings, request->capture_size);
    settings.env_rotate = request->capture_rotate;
    const glint_renderer_inputs inputs = {.device = device,
                                          .scene = &capture->scene,
                                          .environment = &capture->behind,
                                          .settings = &settings,
                                          .kernel_dir = request->inputs.kernel_dir};
    if (capture->renderer != NULL && glint_fingerprints_equal(capture->shown, capture->scene_is)) {
        return GLINT_OK;
    }
    capture->shown = (glint_fingerprint){0};
    if (capture->renderer == NULL) {
        TRY(glint_renderer_create(&inputs, &capture->renderer, error));
    } else {
        TRY(glint_renderer_set_scene(capture->renderer, &capture->scene, error));
    }
    capture->shown = capture->scene_is;
    return GLINT_OK;
}

static bool go_on(void *context, uint64_t done, uint64_t total)
{
    (void)context, (void)done, (void)total;
    return !glint_stop_requested();
}

static char *name_of(const render_capture *capture, const render_request *request)
{
    char *name = NULL;
    const int printed = asprintf(
        &name, "capture:%.200s (%d pixels, in %.200s turned by %g degrees)", request->capture,
        request->capture_size, capture->behind.name, request->capture_rotate);
    return printed < 0 ? NULL : name;
}

glint_status render_capture_take(render_capture *capture, const render_request *request,
                                 glint_device *device, glint_inputs *inputs, glint_error *error)
{
    const glint_progress progress = {go_on, NULL};
    const int edge = request->capture_size;
    const double begun = glint_now_ms();
    glint_cube cube = {0};
    TRY(prepare_renderer(capture, request, device, error));
    TRY(glint_capture(&(glint_capture_request){capture->renderer, capture->at, &progress, NULL},
                      &cube, error));
    char *name = name_of(capture, request);
    if (name == NULL) {
        glint_cube_free(&cube);
        return glint_fail_memory(error, "an environment's name");
    }
    glint_cube_mend(name, &cube, &inputs->warnings);
    glint_environment_free(&inputs->environment);
    inputs->environment = (glint_environment){.name = name,
                                              .layout = GLINT_LAYOUT_CUBE,
                                              .reason = "captured from the scene",
                                              .source_width = edge,
                                              .source_height = 6 * edge,
                                              .proxy = capture->proxy,
                                              .radiance = cube};
    inputs->environment_ms += glint_now_ms() - begun;
    if (inputs->source == NULL) { // nothing moves: there is no second capture
        glint_renderer_free(capture->renderer);
        capture->renderer = NULL;
        glint_scene_free(&capture->scene);
    }
    return GLINT_OK;
}

void render_capture_free(render_capture *capture)
{
    glint_renderer_free(capture->renderer);
    glint_environment_free(&capture->behind);
    glint_scene_free(&capture->scene);
    *capture = (render_capture){0};
}
