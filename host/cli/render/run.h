// Renders the frames of glint render, one or many, from the shot to the files.
#ifndef GLINT_CLI_RENDER_RUN_H
#define GLINT_CLI_RENDER_RUN_H

#include "cli/render/frames.h"
#include "cli/render/kernels_ahead.h"
#include "cli/render/shot.h"
#include "cli/render/tracer.h"

// All the state of a run. Zero is valid.
typedef struct render_run {
    const render_request *request; // borrowed
    glint_progress_display display;
    render_shot shot;
    render_tracer tracer;
    render_frames frames;
    render_kernels_ahead kernels;
    double build_ms;           // build time of the frame that is being traced
    glint_error_choice choice; // the latest choice of --max-error
    double rendering_begun_ms; // milliseconds after the display began
} render_run;

// Opens the device and creates the renderer with the first frame that can be rendered. The shot
// must be loaded and the frames begun. Errors: as loading, GLINT_DEVICE_FAILED.
glint_status render_run_prepare(render_run *run, glint_error *error);

// Renders the frames to their files and reports each. In a sequence, an error that concerns one
// frame does not stop the others. Errors: the error that ended the run.
glint_status render_run_frames(render_run *run, glint_error *error);

void render_run_free(render_run *run);

#endif
