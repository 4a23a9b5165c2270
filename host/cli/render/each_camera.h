// --camera all: a picture, or a sequence, for each of the file's cameras.
#ifndef GLINT_CLI_RENDER_EACH_CAMERA_H
#define GLINT_CLI_RENDER_EACH_CAMERA_H

#include "cli/render/request.h"

// Whether all cameras are asked for.
bool render_each_camera_is_asked(const render_request *request);

// Calls `render` once for each camera, with a request that names the camera and files of its own;
// `request` must be as it was parsed. All requests are checked before the first is rendered. Frames
// that fail do not stop the other cameras, nor does a camera without a direction. Errors: as
// render_request_finish; GLINT_BAD_INPUT (no cameras); as `render`.
glint_status render_each_camera(const render_request *request,
                                glint_status (*render)(render_request *one, glint_error *error),
                                glint_error *error);

#endif
