// Runs one pass over a frame's pixels with the renderer's settings. Used in this folder only.
#ifndef GLINT_RENDER_PASS_H
#define GLINT_RENDER_PASS_H

#include "render/renderer.h"

// Renders the pixels that the settings ask for. request->report must not be NULL. Errors: as
// glint_renderer_frame; the image is then empty.
glint_status glint_pass_run(const glint_frame_request *request, glint_error *error);

#endif
