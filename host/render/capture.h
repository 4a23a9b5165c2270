// Renders the environment at a place of a scene: six views of 90 degrees.
#ifndef GLINT_RENDER_CAPTURE_H
#define GLINT_RENDER_CAPTURE_H

#include "environment/environment.h"
#include "render/frame.h"

// The settings of a renderer for captures: `settings`, but with square views of `edge` pixels,
// without transparent background and layers.
glint_settings glint_capture_settings(const glint_settings *settings, int edge);

// The inputs of a capture. Pointers are borrowed.
typedef struct glint_capture_request {
    glint_renderer *renderer;
    glint_vec3 at;                  // metres, world space
    const glint_progress *progress; // may be NULL; counts over all six views
    // May be NULL. The sum of the counts and times of all views.
    glint_frame_report *report;
} glint_capture_request;

// Renders the views into a cube map in the world's axes; rotations by the renderer's settings
// apply. *cube may be unset. Errors: as glint_renderer_frame; GLINT_USAGE if the renderer's frames
// are not square. *cube is then empty.
glint_status glint_capture(const glint_capture_request *request, glint_cube *cube,
                           glint_error *error);

#endif
