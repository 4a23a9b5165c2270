// An environment that is captured from the scene: what is around the nodes that it lights.
#ifndef GLINT_CLI_RENDER_CAPTURE_H
#define GLINT_CLI_RENDER_CAPTURE_H

#include "cli/render/stage.h"
#include "render/frame.h"

// Zero is valid: nothing is captured yet.
typedef struct render_capture {
    glint_environment behind; // all that is captured. Owned
    glint_fingerprint behind_is;
    glint_scene scene; // without what is lit; owned
    glint_fingerprint scene_is;
    bool stands;   // `scene` is that of `time`
    double time;   // seconds of the animation
    glint_vec3 at; // where it is captured from (metres, world space)
    glint_proxy proxy;
    glint_renderer *renderer; // of `scene`; NULL before the first capture. Owned
    glint_fingerprint shown;  // the scene that the renderer shows
} render_capture;

// Brings what is around to the time that the stage stands at, and finds the fingerprint `is` of the
// environment that it makes. A display (may be NULL) tells. Errors: as loading.
glint_status render_capture_prepare(render_capture *capture, const render_stage *stage,
                                    glint_progress_display *display, glint_fingerprint *is,
                                    glint_error *error);

// Renders what has been prepared, in the place of inputs->environment. Errors: as rendering;
// GLINT_INTERRUPTED where a stop is requested.
glint_status render_capture_take(render_capture *capture, const render_request *request,
                                 glint_device *device, glint_inputs *inputs, glint_error *error);

void render_capture_free(render_capture *capture);

#endif
