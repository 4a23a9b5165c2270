// The environment at a place of a scene: six views of 90 degrees.
#ifndef GLINT_RENDER_CAPTURE_H
#define GLINT_RENDER_CAPTURE_H

#include "environment/environment.h"
#include "render/frame.h"

// The settings of a renderer for captures: those of a frame, for square views of `edge` pixels
// without holes and layers.
glint_settings glint_capture_settings(const glint_settings *settings, int edge);

// Views to render. Pointers are borrowed.
typedef struct glint_capture_request {
    glint_renderer *renderer;
    glint_vec3 at;                  // metres, world space
    const glint_progress *progress; // may be NULL; counts over all six views
    glint_frame_report *report;     // may be NULL; what all views counted, and the times of all
} glint_capture_request;

// Renders the views into a cube map, in the world's axes: what the renderer's settings turn is
// turned. *cube need not be set. Errors: as glint_renderer_frame; GLINT_USAGE where the renderer's
// frames are not square. *cube is then empty.
glint_status glint_capture(const glint_capture_request *request, glint_cube *cube,
                           glint_error *error);

#endif
