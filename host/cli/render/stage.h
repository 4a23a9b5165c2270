// Moves the scene and the camera to a frame's time.
#ifndef GLINT_CLI_RENDER_STAGE_H
#define GLINT_CLI_RENDER_STAGE_H

#include "cli/common/inputs.h"
#include "cli/render/ahead.h"
#include "cli/render/request.h"
#include "report/frame/fingerprint.h"

#include <stdbool.h>

// The scene and camera of a frame. Zero is valid and empty.
typedef struct render_stage {
    const render_request *request; // borrowed
    // scene and viewpoint at `time`; render_light manages the environment
    glint_inputs inputs;
    glint_fingerprint is; // fingerprint of inputs.scene
    bool stands;          // inputs.scene and inputs.viewpoint are at `time`
    bool is_prepared;     // the renderer is prepared for inputs.scene
    double time;          // seconds of the animation
    double loading_ms;    // time to load the scene for this frame; 0 if it did not change
    char *path;           // the scene's file; it outlives inputs.scene. Owned
    char *camera_name;    // outlives inputs.scene. Owned
    render_ahead ahead;   // loads the next frame's scene
} render_stage;

// Loads the scene at time 0. Errors: as loading.
glint_status render_stage_load(render_stage *stage, const render_request *request,
                               glint_progress_display *display, glint_error *error);

// Moves scene and camera to a frame. Errors: as glint_scene_at.
glint_status render_stage_set(render_stage *stage, int frame, glint_error *error);

// The camera of a frame; the stage must stand at the frame's time.
glint_camera render_stage_camera(const render_stage *stage, int frame);

void render_stage_free(render_stage *stage);

#endif
