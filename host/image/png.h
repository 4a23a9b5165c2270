// Encodes PNG files on all cores, in this process.
//
// PNG is the format for looking at a picture at once. The codec's libraries take longer to load
// than a small picture takes to render and encode.
#ifndef GLINT_IMAGE_PNG_H
#define GLINT_IMAGE_PNG_H

#include "image/file_values.h"

// Encodes an image as a file in memory, which the caller frees. The bytes depend on the image and
// the options alone, for any number of threads (0: one for each core). `path` is its name in
// messages. Errors: GLINT_OUTPUT_FAILED with the path: not enough memory, or too large for a PNG.
glint_status glint_png_encode(const char *path, const glint_file_values *values, size_t threads,
                              glint_encoded *encoded, glint_error *error);

#endif
