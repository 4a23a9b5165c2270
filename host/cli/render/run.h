// The frames of `glint render`, one or many, from what they show to their files.
#ifndef GLINT_CLI_RENDER_RUN_H
#define GLINT_CLI_RENDER_RUN_H

#include "cli/render/frames.h"
#include "cli/render/shot.h"
#include "cli/render/tracer.h"

// Zero is valid.
typedef struct render_run {
    const render_request *request; // borrowed
    glint_progress_display display;
    render_shot shot;
    render_tracer tracer;
    render_frames frames;
    double build_ms;           // of the frame that is traced
    glint_error_choice choice; // the last one of --max-error
    double rendering_begun_ms; // since the display began
} render_run;

// Opens the device and makes the renderer of the shot as the first frame shows it that can be
// shown. The shot must be loaded, the frames begun. Errors: as loading, GLINT_DEVICE_FAILED.
glint_status render_run_prepare(render_run *run, glint_error *error);

// Renders the frames, each to its file, and says what is to be said of each. What fails of one
// frame alone does not stop the others of a sequence. Errors: what ended the run.
glint_status render_run_frames(render_run *run, glint_error *error);

void render_run_free(render_run *run);

#endif
