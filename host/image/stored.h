// Converts a picture as its file stores it to an image: linear, premultiplied, upright.
#ifndef GLINT_IMAGE_STORED_H
#define GLINT_IMAGE_STORED_H

#include "base/status.h"
#include "image/decoder.h"
#include "image/image.h"

// Converts `stored`, which has 1 to 4 channels. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_stored_develop(const glint_stored *stored, glint_image *image,
                                  glint_error *error);

#endif
