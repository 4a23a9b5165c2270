// Loads the environment of a run's frames: one file for all, one file per frame, or a capture of
// the scene.
#ifndef GLINT_CLI_RENDER_LIGHT_H
#define GLINT_CLI_RENDER_LIGHT_H

#include "cli/render/capture.h"
#include "cli/render/stage.h"

// The light of a run. Zero is valid. The stage holds the environment itself (inputs.environment).
typedef struct render_light {
    glint_fingerprint is; // fingerprint of the environment that the frame needs
    // fingerprint of the stage's environment; a capture is rendered only when a frame needs it
    glint_fingerprint loaded;
    bool has_file; // the stage holds the file of frame `frame`
    int frame;
    render_capture capture;
} render_light;

// Loads the environment that all frames share. Errors: as glint_inputs_load_environment.
glint_status render_light_load(render_light *light, render_stage *stage,
                               glint_progress_display *display, glint_error *error);

// Loads the first environment of a run: the shared one or the file of frame `first`. It lets a
// caller check early that the file can be read. Errors: as glint_inputs_load_environment.
glint_status render_light_try(const render_request *request, int first,
                              glint_progress_display *display, glint_inputs *inputs,
                              glint_error *error);

// Finds the light of the frame at which the stage stands: loads its file, or prepares a capture.
// `display` (NULL once frames are rendered) shows the phase. Errors: as loading.
glint_status render_light_set(render_light *light, render_stage *stage, int frame,
                              glint_progress_display *display, glint_error *error);

// Makes this light the stage's environment; renders a prepared capture. Errors: as rendering.
glint_status render_light_make(render_light *light, render_stage *stage, glint_device *device,
                               glint_error *error);

void render_light_free(render_light *light);

#endif
