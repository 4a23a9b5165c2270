// One pass over a frame's pixels, with the renderer's settings. For this floor only.
#ifndef GLINT_RENDER_PASS_H
#define GLINT_RENDER_PASS_H

#include "render/renderer.h"

// Pointers are borrowed.
typedef struct glint_pass {
    glint_renderer *renderer;
    const glint_camera *camera;
    const glint_progress *progress; // may be NULL
    glint_image *image;             // see glint_renderer_frame; empty on failure
    glint_frame_report *report;
} glint_pass;

// Renders the pixels that the settings ask for; *report is set. Errors: as glint_renderer_frame.
glint_status glint_pass_run(const glint_pass *pass, glint_error *error);

#endif
