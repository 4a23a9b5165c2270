// Plates: pictures that stand behind frames.
#ifndef GLINT_CLI_RENDER_PLATE_H
#define GLINT_CLI_RENDER_PLATE_H

#include "cli/render/request.h"
#include "image/image.h"
#include "report/frame/fingerprint.h"

// What a frame's plate holds; zero without plates. Errors: GLINT_BAD_INPUT.
glint_status render_plate_fingerprint(const render_request *request, int frame,
                                      glint_fingerprint *is, glint_error *error);

// Reads a frame's plate to see whether it serves. Errors: GLINT_BAD_INPUT.
glint_status render_plate_check(const render_request *request, int frame, glint_error *error);

// Puts the plate at `path` behind a frame. Errors: GLINT_BAD_INPUT.
glint_status render_plate_put_behind(const char *path, glint_image *image, glint_error *error);

#endif
