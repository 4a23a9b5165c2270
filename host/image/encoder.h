// Encodes image files in another process. See encoding.h.
#ifndef GLINT_IMAGE_ENCODER_H
#define GLINT_IMAGE_ENCODER_H

#include "image/file_values.h"

// Encodes an image as a file in memory, which the caller frees. `path` is its name in messages.
// Errors: GLINT_OUTPUT_FAILED with the path, also if the process died; GLINT_OUT_OF_MEMORY.
glint_status glint_encoder_run(const char *path, const glint_file_values *values,
                               glint_encoded *encoded, glint_error *error);

#endif
