// Encodes PNG files in this process.
//
// PNG is the format for looking at a picture at once. The codec's libraries take longer to load
// than a small picture takes to render and encode.
#ifndef GLINT_IMAGE_PNG_H
#define GLINT_IMAGE_PNG_H

#include "image/file_values.h"

// Encodes an image as a file in memory, which the caller frees. Converts its pixels on `threads`
// threads (0: one for each core). The bytes depend on the image and the options alone. `path` is
// the file's name in messages. Errors: GLINT_OUTPUT_FAILED with the path: not enough memory, or
// more than a million pixels wide or high, which libpng refuses.
glint_status glint_png_encode(const char *path, const glint_file_values *values, size_t threads,
                              glint_encoded *encoded, glint_error *error);

#endif
