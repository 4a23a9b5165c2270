// Brings together what a frame shows: scene, camera, light, plate and their fingerprint.
#ifndef GLINT_CLI_RENDER_SHOT_H
#define GLINT_CLI_RENDER_SHOT_H

#include "cli/render/light.h"
#include "cli/render/stage.h"
#include "report/frame/fingerprint.h"

// The shot of a frame. Zero is valid and empty.
typedef struct render_shot {
    const render_request *request;   // borrowed
    glint_progress_display *display; // shows loading; borrowed, NULL once frames are rendered
    render_stage stage;
    render_light light;
    glint_fingerprint plate_is; // zero without a plate
    glint_fingerprint shared;   // fingerprint of the shared settings; set once the renderer exists
} render_shot;

// Loads the request's scene and light at time 0. Errors: as loading.
glint_status render_shot_load(render_shot *shot, const render_request *request,
                              glint_progress_display *display, glint_error *error);

// Moves scene, camera, light and plate to a frame. *ms is the time for scene and light, which
// counts as the frame's build time. Errors: as loading.
glint_status render_shot_set(render_shot *shot, int frame, double *ms, glint_error *error);

// Writes the fingerprint of the current frame, as `camera` sees it.
void render_shot_fingerprint(const render_shot *shot, const glint_camera *camera,
                             char text[GLINT_FINGERPRINT_TEXT]);

void render_shot_free(render_shot *shot);

#endif
