// Reads plates: pictures that stand behind frames.
#ifndef GLINT_CLI_RENDER_PLATE_H
#define GLINT_CLI_RENDER_PLATE_H

#include "cli/render/request.h"
#include "image/image.h"
#include "report/frame/fingerprint.h"

// The fingerprint of a frame's plate; zero without plates. Errors: GLINT_BAD_INPUT.
glint_status render_plate_fingerprint(const render_request *request, int frame,
                                      glint_fingerprint *is, glint_error *error);

// Checks that the frame's plate can be read and fits. Errors: GLINT_BAD_INPUT.
glint_status render_plate_check(const render_request *request, int frame, glint_error *error);

// Composites the frame over the plate at `path`. Errors: GLINT_BAD_INPUT.
glint_status render_plate_put_behind(const char *path, glint_image *image, glint_error *error);

#endif
