// Environments of frames. See render_light.h.
#include "cli/render/light.h"

#include "base/clock.h"
#include "cli/common/signals.h"
#include "cli/render/run.h"
#include "environment/radiance.h"
#include "render/capture.h"
#include "scene/subset.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Captures ----------------------------------------------------------------------------------

// The scene around what is lit, at the run's time.
static glint_status load_scene(render_run *run, glint_scene *scene, glint_error *error)
{
    glint_input_request request = run->request->inputs;
    request.only = NULL;
    request.camera_may_wait = true; // nothing is seen through it
    if (run->inputs.source != NULL) {
        glint_viewpoint unused;
        glint_status status = glint_scene_at(run->inputs.source, run->time, scene, NULL, error);
        return status == GLINT_OK ? glint_inputs_stage(&request, scene, &unused, error) : status;
    }
    glint_inputs inputs;
    glint_status status = glint_inputs_load_scene(&request, &run->display, &inputs, error);
    *scene = inputs.scene;
    inputs.scene = (glint_scene){0};
    glint_inputs_free(&inputs);
    return status;
}

static glint_status prepare_capture(render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    render_light *light = &run->light;
    if (light->stands && light->time == run->time) {
        return GLINT_OK;
    }
    if (run->renderer == NULL) {
        glint_progress_phase(&run->display, "capture", "capturing what is around");
    }
    light->stands = false;
    glint_scene_free(&light->scene);
    glint_status status = load_scene(run, &light->scene, error);
    if (status == GLINT_OK) {
        status = glint_scene_middle_of_nodes(&light->scene, request->capture, &light->at, error);
    }
    if (status == GLINT_OK) {
        status = glint_scene_remove_nodes(&light->scene, request->capture, error);
    }
    if (status == GLINT_OK) {
        status = glint_fingerprint_scene(&light->scene, &light->scene_is, error);
    }
    if (status == GLINT_OK) {
        status = proxy_option_make(&request->proxy, light->at, &light->scene, &light->proxy, error);
    }
    if (status == GLINT_OK) {
        // What is around tells the proxy's bounds.
        const glint_fingerprint parts[] = {light->surroundings_are, light->scene_is};
        const double *n = request->proxy.numbers;
        char text[400];
        snprintf(text, sizeof text, "capture %d %a %a %a %a %d %a %a %a %a %a %a",
                 request->capture_size, light->at.x, light->at.y, light->at.z,
                 request->capture_rotate, (int)request->proxy.kind, n[0], n[1], n[2], n[3], n[4],
                 n[5]);
        light->is = glint_fingerprint_join(parts, 2, text);
        light->time = run->time;
        light->stands = true;
    }
    return status;
}

// The renderer of the views, showing the scene around.
static glint_status prepare_capturer(render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    render_light *light = &run->light;
    glint_settings settings =
        glint_capture_settings(&request->inputs.settings, request->capture_size);
    settings.env_rotate = request->capture_rotate;
    const glint_renderer_inputs inputs = {.device = run->device,
                                          .scene = &light->scene,
                                          .environment = &light->surroundings,
                                          .settings = &settings,
                                          .kernel_dir = request->inputs.kernel_dir};
    if (light->capturer != NULL &&
        glint_fingerprints_equal(light->capturer_shows, light->scene_is)) {
        return GLINT_OK;
    }
    light->capturer_shows = (glint_fingerprint){0};
    glint_status status = light->capturer == NULL
                              ? glint_renderer_create(&inputs, &light->capturer, error)
                              : glint_renderer_set_scene(light->capturer, &light->scene, error);
    if (status == GLINT_OK) {
        light->capturer_shows = light->scene_is;
    }
    return status;
}

static bool step(void *context, uint64_t done, uint64_t total)
{
    (void)context, (void)done, (void)total;
    return !glint_stop_requested();
}

static glint_status capture(render_run *run, glint_error *error)
{
    render_light *light = &run->light;
    glint_environment *environment = &run->inputs.environment;
    const glint_progress progress = {step, NULL};
    const int edge = run->request->capture_size;
    glint_cube cube = {0};
    char name[600];
    const double begun = glint_now_ms();
    glint_status status = prepare_capturer(run, error);
    if (status == GLINT_OK) {
        status = glint_capture(light->capturer, light->at, &progress, &cube, NULL, error);
    }
    const render_request *request = run->request;
    snprintf(name, sizeof name, "capture:%.200s (%d pixels, in %.200s turned by %g degrees)",
             request->capture, edge, light->surroundings.name, request->capture_rotate);
    char *copy = status == GLINT_OK ? strdup(name) : NULL;
    if (status == GLINT_OK && copy == NULL) {
        glint_cube_free(&cube);
        status = glint_fail_memory(error, "an environment's name");
    }
    if (status != GLINT_OK) {
        return status;
    }
    glint_cube_mend(name, &cube, &run->inputs.warnings);
    glint_environment_free(environment);
    *environment = (glint_environment){.name = copy,
                                       .layout = GLINT_LAYOUT_CUBE,
                                       .reason = "captured from the scene",
                                       .source_width = edge,
                                       .source_height = 6 * edge,
                                       .proxy = light->proxy,
                                       .radiance = cube};
    light->loaded = light->is;
    run->inputs.environment_ms += glint_now_ms() - begun;
    if (run->inputs.source == NULL) { // that was the only one
        glint_renderer_free(light->capturer);
        light->capturer = NULL;
        glint_scene_free(&light->scene);
    }
    return GLINT_OK;
}

// ---- Files of frames ---------------------------------------------------------------------------

// A file's; captures have theirs (prepare_capture).
static glint_status set_proxy(const render_request *request, glint_inputs *inputs,
                              glint_error *error)
{
    const double *at = request->env_at.at;
    return request->capture != NULL
               ? GLINT_OK
               : proxy_option_make(&request->proxy, (glint_vec3){at[0], at[1], at[2]},
                                   &inputs->scene, &inputs->environment.proxy, error);
}

glint_status render_light_try(const render_request *request, int first,
                              glint_progress_display *display, glint_inputs *inputs,
                              glint_error *error)
{
    if (request->env_name.length == 0) {
        glint_status loaded =
            glint_inputs_load_environment(&request->inputs, display, inputs, error);
        return loaded == GLINT_OK ? set_proxy(request, inputs, error) : loaded;
    }
    glint_input_request of_frame = request->inputs;
    char *path = glint_frame_name_make(&request->env_name, first);
    of_frame.env = path;
    glint_status status = path != NULL
                              ? glint_inputs_load_environment(&of_frame, display, inputs, error)
                              : glint_fail_memory(error, "a file name");
    free(path);
    return status == GLINT_OK ? set_proxy(request, inputs, error) : status;
}

static glint_status load_file(render_run *run, int frame, glint_error *error)
{
    render_light *light = &run->light;
    if (light->has_file && light->frame == frame) {
        return GLINT_OK;
    }
    light->has_file = false;
    light->loaded = (glint_fingerprint){0};
    glint_environment_free(&run->inputs.environment);
    // Once frames are rendered, the display shows them.
    glint_progress_display *display = run->renderer == NULL ? &run->display : NULL;
    glint_status status = render_light_try(run->request, frame, display, &run->inputs, error);
    if (status == GLINT_OK) {
        status = glint_fingerprint_environment(&run->inputs.environment, &light->is, error);
    }
    if (status == GLINT_OK) {
        light->loaded = light->is;
        light->frame = frame;
        light->has_file = true;
    }
    return status;
}

// ------------------------------------------------------------------------------------------------

glint_status render_light_load(render_run *run, glint_error *error)
{
    const render_request *request = run->request;
    render_light *light = &run->light;
    if (request->env_name.length > 0) {
        return GLINT_OK;
    }
    glint_status status = render_light_try(request, 1, &run->display, &run->inputs, error);
    if (status == GLINT_OK) {
        status = glint_fingerprint_environment(&run->inputs.environment, &light->loaded, error);
    }
    if (status == GLINT_OK && request->capture != NULL) {
        light->surroundings = run->inputs.environment;
        light->surroundings_are = light->loaded;
        light->loaded = (glint_fingerprint){0};
        run->inputs.environment = (glint_environment){0};
    }
    light->is = light->loaded;
    return status;
}

glint_status render_light_set(render_run *run, int frame, glint_error *error)
{
    return run->request->capture != NULL       ? prepare_capture(run, error)
           : run->request->env_name.length > 0 ? load_file(run, frame, error)
                                               : GLINT_OK;
}

glint_status render_light_show(render_run *run, glint_error *error)
{
    render_light *light = &run->light;
    glint_status status = GLINT_OK;
    if (!glint_fingerprints_equal(light->loaded, light->is)) {
        status = capture(run, error);
    }
    if (status == GLINT_OK && run->renderer != NULL &&
        !glint_fingerprints_equal(light->shown, light->loaded)) {
        light->shown = (glint_fingerprint){0};
        status = glint_renderer_set_environment(run->renderer, &run->inputs.environment, error);
    }
    if (status == GLINT_OK && run->request->max_error > 0 &&
        !glint_fingerprints_equal(light->weighed, light->loaded)) {
        glint_error_bound_set_environment(&run->bound, &run->inputs.environment.radiance);
        light->weighed = light->loaded;
    }
    if (status == GLINT_OK) {
        light->shown = light->loaded;
    }
    return status;
}

void render_light_free(render_light *light)
{
    glint_renderer_free(light->capturer);
    glint_environment_free(&light->surroundings);
    glint_scene_free(&light->scene);
    *light = (render_light){0};
}
