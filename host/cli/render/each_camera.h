// Implements --camera all: renders a picture or a sequence for each camera of the file.
#ifndef GLINT_CLI_RENDER_EACH_CAMERA_H
#define GLINT_CLI_RENDER_EACH_CAMERA_H

#include "cli/render/request.h"

// True if the user asked for all cameras.
bool render_each_camera_is_asked(const render_request *request);

// Calls `render` once per camera, with a request that names the camera and its own output files.
// `request` must be fresh from the parser. All requests are checked before the first is rendered.
// Failed frames do not stop the other cameras; a camera without a direction does not either.
// Errors: as render_request_finish; GLINT_BAD_INPUT (no cameras); as `render`.
glint_status render_each_camera(const render_request *request,
                                glint_status (*render)(render_request *one, glint_error *error),
                                glint_error *error);

#endif
