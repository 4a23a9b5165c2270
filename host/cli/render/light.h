// What lights a run's frames: one environment for all, a file for each, or one that is captured
// from the scene.
#ifndef GLINT_CLI_RENDER_LIGHT_H
#define GLINT_CLI_RENDER_LIGHT_H

#include "cli/render/capture.h"
#include "cli/render/stage.h"

// Zero is valid. The environment itself is the stage's (inputs.environment).
typedef struct render_light {
    glint_fingerprint is;     // of what the frame is to have
    glint_fingerprint loaded; // of what there is; a capture is made when a frame is to be rendered
    bool has_file;            // of frame `frame`: what there is is its file's
    int frame;
    render_capture capture;
} render_light;

// Loads what all frames share. Errors: as glint_inputs_load_environment.
glint_status render_light_load(render_light *light, render_stage *stage,
                               glint_progress_display *display, glint_error *error);

// Loads what a run would begin with, its environment or that of the frame `first`, for whoever
// wants to know whether it can. Errors likewise.
glint_status render_light_try(const render_request *request, int first,
                              glint_progress_display *display, glint_inputs *inputs,
                              glint_error *error);

// Finds what is to light a frame, at which the stage stands; its file is loaded, a capture is
// only prepared. A display (NULL once frames are rendered) tells. Errors: as loading.
glint_status render_light_set(render_light *light, render_stage *stage, int frame,
                              glint_progress_display *display, glint_error *error);

// Makes that the stage's environment. Errors: as rendering.
glint_status render_light_make(render_light *light, render_stage *stage, glint_device *device,
                               glint_error *error);

void render_light_free(render_light *light);

#endif
