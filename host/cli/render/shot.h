// What a frame shows: its scene, camera, light and plate, and the fingerprint of them all.
#ifndef GLINT_CLI_RENDER_SHOT_H
#define GLINT_CLI_RENDER_SHOT_H

#include "cli/render/light.h"
#include "cli/render/stage.h"
#include "report/frame/fingerprint.h"

// Zero is valid and empty.
typedef struct render_shot {
    const render_request *request;   // borrowed
    glint_progress_display *display; // of what is loaded; borrowed, NULL once frames are rendered
    render_stage stage;
    render_light light;
    glint_fingerprint plate_is; // zero without one
    glint_fingerprint shared;   // of what all frames share; set once the renderer is there
} render_shot;

// Loads what the request names, as it is at time 0. Errors: as loading.
glint_status render_shot_load(render_shot *shot, const render_request *request,
                              glint_progress_display *display, glint_error *error);

// Moves scene, camera, light and plate to a frame. *ms: what it took that belongs to the frame's
// building. Errors: as loading.
glint_status render_shot_set(render_shot *shot, int frame, double *ms, glint_error *error);

// Of the frame that the shot stands at, as `camera` sees it.
void render_shot_fingerprint(const render_shot *shot, const glint_camera *camera,
                             char text[GLINT_FINGERPRINT_TEXT]);

void render_shot_free(render_shot *shot);

#endif
