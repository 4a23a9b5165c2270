// Scene and camera at a frame's time.
#ifndef GLINT_CLI_RENDER_STAGE_H
#define GLINT_CLI_RENDER_STAGE_H

#include "cli/common/inputs.h"
#include "cli/render/ahead.h"
#include "cli/render/request.h"
#include "report/frame/fingerprint.h"

#include <stdbool.h>

// Zero is valid and empty.
typedef struct render_stage {
    const render_request *request; // borrowed
    glint_inputs inputs;  // scene and viewpoint at `time`; the environment is render_light's
    glint_fingerprint is; // of inputs.scene
    bool stands;          // inputs.scene and inputs.viewpoint are those of `time`
    bool is_prepared;     // the renderer, for inputs.scene
    double time;          // seconds of the animation
    double loading_ms;    // what this frame's scene took, if it is another than the last one's
    char *path;           // of the scene; it outlives scenes of other times. Owned
    char *camera_name;    // likewise
    render_ahead ahead;   // the next frame's scene
} render_stage;

// Loads the scene as it is at time 0. Errors: as loading.
glint_status render_stage_load(render_stage *stage, const render_request *request,
                               glint_progress_display *display, glint_error *error);

// Moves scene and camera to a frame. Errors: as glint_scene_at.
glint_status render_stage_set(render_stage *stage, int frame, glint_error *error);

// The camera of a frame at whose time the scene stands.
glint_camera render_stage_camera(const render_stage *stage, int frame);

void render_stage_free(render_stage *stage);

#endif
