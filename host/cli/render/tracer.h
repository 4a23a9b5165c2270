// What a run's frames are rendered with: the device, and the renderer of what the shot shows.
#ifndef GLINT_CLI_RENDER_TRACER_H
#define GLINT_CLI_RENDER_TRACER_H

#include "bound/error_bound.h"
#include "cli/render/shot.h"
#include "device/device.h"
#include "render/frame.h"
#include "report/frame/subject.h"

// Zero is valid and empty.
typedef struct render_tracer {
    glint_device *device;            // owned
    glint_renderer *renderer;        // owned
    glint_fingerprint scene;         // that the renderer has
    glint_fingerprint light;         // likewise
    glint_fingerprint weighed_light; // that `bound` has been told of
    glint_error_bound bound;         // --max-error
    const char *tree;                // what came of the frame's tree: "kept", "fitted" or "built"
} render_tracer;

// Opens the device and makes the renderer of the shot, where that has not been done. Errors: as
// glint_device_open, glint_renderer_create and capturing.
glint_status render_tracer_begin(render_tracer *tracer, render_shot *shot, glint_error *error);

// Gives the renderer the shot's scene and light, unless it has them. Errors: as
// glint_renderer_set_scene, glint_renderer_set_environment and capturing.
glint_status render_tracer_show(render_tracer *tracer, render_shot *shot, glint_error *error);

// Begins on the scene of frame `next`, if it is another than the shot's; with its tree, unless
// `may_skip` it. To be called once the renderer shows the shot.
void render_tracer_look_ahead(render_tracer *tracer, render_shot *shot, int next, bool may_skip);

// Of the shot as it stands, and the renderer.
glint_subject render_tracer_subject(const render_tracer *tracer, const render_shot *shot);

void render_tracer_free(render_tracer *tracer);

#endif
