// Captures an environment from the scene around the nodes that it lights.
#ifndef GLINT_CLI_RENDER_CAPTURE_H
#define GLINT_CLI_RENDER_CAPTURE_H

#include "cli/render/stage.h"
#include "render/frame.h"

// A captured environment and its renderer. Zero is valid: nothing is captured yet.
typedef struct render_capture {
    glint_environment behind; // the environment behind the captured scene. Owned
    glint_fingerprint behind_is;
    glint_scene scene; // the scene without the lit nodes; owned
    glint_fingerprint scene_is;
    bool stands;   // `scene` is the scene at `time`
    double time;   // seconds of the animation
    glint_vec3 at; // the point of capture (metres, world space)
    glint_proxy proxy;
    glint_renderer *renderer; // shows `scene`; NULL before the first capture. Owned
    glint_fingerprint shown;  // the scene that the renderer shows
} render_capture;

// Loads the surrounding scene at the stage's time. Sets `is` to the fingerprint of the environment
// that a capture would give. `display` (may be NULL) shows the phase. Errors: as loading.
glint_status render_capture_prepare(render_capture *capture, const render_stage *stage,
                                    glint_progress_display *display, glint_fingerprint *is,
                                    glint_error *error);

// Renders the prepared capture and stores it in inputs->environment. Errors: as rendering;
// GLINT_INTERRUPTED if a stop is requested.
glint_status render_capture_take(render_capture *capture, const render_request *request,
                                 glint_device *device, glint_inputs *inputs, glint_error *error);

void render_capture_free(render_capture *capture);

#endif
