// Opens the device and keeps its renderer up to date with the shot.
#ifndef GLINT_CLI_RENDER_TRACER_H
#define GLINT_CLI_RENDER_TRACER_H

#include "bound/error_bound.h"
#include "cli/render/shot.h"
#include "device/device.h"
#include "render/frame.h"
#include "report/frame/subject.h"

// The device and renderer of a run. Zero is valid and empty.
typedef struct render_tracer {
    glint_device *device;            // owned
    glint_renderer *renderer;        // owned
    glint_fingerprint scene;         // the renderer's scene
    glint_fingerprint light;         // the renderer's environment
    glint_fingerprint weighed_light; // the environment that `bound` knows
    glint_error_bound bound;         // --max-error
    const char *tree;                // how the frame got its tree: "kept", "fitted" or "built"
} render_tracer;

// Opens the device, unless it is open, and creates the renderer for the shot. Errors: as
// glint_device_open, glint_renderer_create and capturing.
glint_status render_tracer_begin(render_tracer *tracer, render_shot *shot, glint_error *error);

// Gives the renderer the shot's scene and light if they changed. Errors: as
// glint_renderer_set_scene, glint_renderer_set_environment and capturing.
glint_status render_tracer_show(render_tracer *tracer, render_shot *shot, glint_error *error);

// Starts loading the scene of frame `next`, if it differs from the shot's scene. Also builds the
// tree, unless `may_skip` (the frame may keep its file). Call it once the renderer shows the shot.
void render_tracer_look_ahead(render_tracer *tracer, render_shot *shot, int next, bool may_skip);

// Describes the current shot and the renderer for reports.
glint_subject render_tracer_subject(const render_tracer *tracer, const render_shot *shot);

void render_tracer_free(render_tracer *tracer);

#endif
