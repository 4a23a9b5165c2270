// Writes a picture as PNG.
#ifndef GLINT_SCENES_WRITE_PNG_H
#define GLINT_SCENES_WRITE_PNG_H

#include "model.h"

// Writes a PNG without compression: compressed bytes would differ between versions of a library.
// Errors: GLINT_MISMATCH if the picture exceeds one block of 65535 bytes; GLINT_OUTPUT_FAILED.
glint_status write_png(const picture *p, const char *path, glint_error *error);

#endif
