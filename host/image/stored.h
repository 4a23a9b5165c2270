// Reads a picture as its file stores it, and converts it to an image: linear, premultiplied,
// upright.
#ifndef GLINT_IMAGE_STORED_H
#define GLINT_IMAGE_STORED_H

#include "base/status.h"
#include "image/decoder.h"
#include "image/image.h"
#include "image/image_io.h"

#include <stdbool.h>
#include <stddef.h>

// Decodes a file without converting it. Errors: as glint_image_read. The caller frees it.
glint_status glint_image_read_stored(const char *path, glint_stored *stored, glint_error *error);

// The facts that glint_image_read gives.
glint_image_facts glint_image_facts_of(const glint_stored *stored);

// Converts `stored`, which has 1 to 4 channels. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_stored_develop(const glint_stored *stored, glint_image *image,
                                  glint_error *error);

// Converts parts of a picture, for callers that need it once, and not as a whole. Does not turn it
// upright. Zero is valid.
typedef struct glint_development {
    const glint_stored *stored; // borrowed
    float *plain, *linear;      // value of each code: unchanged (owned), and linearised
} glint_development;

// Begins and ends. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_development_begin(const glint_stored *stored, glint_development *development,
                                     glint_error *error);
void glint_development_end(glint_development *development);

// Converts `count` pixels from pixel `first` on, in the order of the rows. Several threads may call
// it at once. False if the decoder truncated the values (glint_stored_fail_of_cut).
bool glint_development_read(const glint_development *development, size_t first, size_t count,
                            float *pixels);

#endif
