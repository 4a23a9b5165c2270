// Loads the environments of frames. See light.h.
#include "cli/render/light.h"

#include <stdlib.h>

// Sets the proxy of an environment from a file. A capture sets its own proxy.
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
    glint_input_request of_frame = request->inputs;
    char *path = NULL;
    if (request->env_name.length > 0) {
        of_frame.env = path = glint_frame_name_make(&request->env_name, first);
        if (path == NULL) {
            return glint_fail_memory(error, "a file name");
        }
    }
    glint_status status = glint_inputs_load_environment(&of_frame, display, inputs, error);
    free(path);
    return status == GLINT_OK ? set_proxy(request, inputs, error) : status;
}

static glint_status load_file(render_light *light, render_stage *stage, int frame,
                              glint_progress_display *display, glint_error *error)
{
    glint_inputs *inputs = &stage->inputs;
    if (light->has_file && light->frame == frame) {
        return GLINT_OK;
    }
    light->has_file = false;
    light->loaded = (glint_fingerprint){0};
    glint_environment_free(&inputs->environment);
    TRY(render_light_try(stage->request, frame, display, inputs, error));
    TRY(glint_fingerprint_environment(&inputs->environment, &light->is, error));
    light->loaded = light->is;
    light->frame = frame;
    light->has_file = true;
    return GLINT_OK;
}

glint_status render_light_load(render_light *light, render_stage *stage,
                               glint_progress_display *display, glint_error *error)
{
    const render_request *request = stage->request;
    glint_inputs *inputs = &stage->inputs;
    if (request->env_name.length > 0) {
        return GLINT_OK;
    }
    TRY(render_light_try(request, 1, display, inputs, error));
    TRY(glint_fingerprint_environment(&inputs->environment, &light->loaded, error));
    if (request->capture != NULL) {
        light->capture.behind = inputs->environment;
        light->capture.behind_is = light->loaded;
        light->loaded = (glint_fingerprint){0};
        inputs->environment = (glint_environment){0};
    }
    light->is = light->loaded;
    return GLINT_OK;
}

glint_status render_light_set(render_light *light, render_stage *stage, int frame,
                              glint_progress_display *display, glint_error *error)
{
    const render_request *request = stage->request;
    return request->capture != NULL
               ? render_capture_prepare(&light->capture, stage, display, &light->is, error)
           : request->env_name.length > 0 ? load_file(light, stage, frame, display, error)
                                          : GLINT_OK;
}

glint_status render_light_make(render_light *light, render_stage *stage, glint_device *device,
                               glint_error *error)
{
    if (!glint_fingerprints_equal(light->loaded, light->is)) {
        TRY(render_capture_take(&light->capture, stage->request, device, &stage->inputs, error));
        light->loaded = light->is;
    }
    return GLINT_OK;
}

void render_light_free(render_light *light)
{
    render_capture_free(&light->capture);
    *light = (render_light){0};
}
