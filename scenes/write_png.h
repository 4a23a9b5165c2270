// Writes a picture as PNG.
#ifndef GLINT_SCENES_WRITE_PNG_H
#define GLINT_SCENES_WRITE_PNG_H

#include "model.h"

// Stored, not compressed: a library's compressed bytes would differ between its versions. A picture
// fits one block of 65535 bytes (GLINT_MISMATCH). Other errors: GLINT_OUTPUT_FAILED.
glint_status write_png(const picture *p, const char *path, glint_error *error);

#endif
