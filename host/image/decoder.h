// Decodes image files in another process. See codec_messages.h.
#ifndef GLINT_IMAGE_DECODER_H
#define GLINT_IMAGE_DECODER_H

#include "base/status.h"
#include "image/codec_messages.h"
#include "image/formats.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The decoder's output for a file: values in a memory file, [height][width][channels], integers of
// code_bits, halfs or floats. glint reads the memory file and does not map it: the decoder may
// still change or truncate it. Zero is valid: nothing is stored.
typedef struct glint_stored {
    const char *path; // path of the image file, borrowed; NULL: there is no memory file
    glint_stored_facts facts;
    size_t value_bytes;
    // With all_channels: bytes of the names after the values, [channels] texts, each with its final
    // zero.
    size_t name_bytes;
    int file; // owned; −1: none
} glint_stored;

// Decodes the file. Errors: GLINT_BAD_INPUT with the file's name, also if the decoder crashed or
// the file exceeds its limits; GLINT_OUT_OF_MEMORY.
glint_status glint_decoder_run(const glint_image_source *source, bool all_channels,
                               glint_stored *stored, glint_error *error);

// Does the same within the caller's limits.
glint_status glint_decoder_run_within(const glint_image_source *source, bool all_channels,
                                      const glint_decode_limits *limits, glint_stored *stored,
                                      glint_error *error);

// The limits of a file of this size, unless glint_decoder_allow_large lifted them.
glint_decode_limits glint_decoder_limits(uint64_t file_bytes);

void glint_stored_free(glint_stored *stored);

// Reads this number of bytes from `offset` on; several threads may read at once. Errors: as
// glint_stored_fail_of_cut.
glint_status glint_stored_read(const glint_stored *stored, size_t offset, void *to, size_t bytes,
                               glint_error *error);

// Fails with GLINT_BAD_INPUT because the decoder truncated the values.
glint_status glint_stored_fail_of_cut(const glint_stored *stored, glint_error *error);

// Lifts the limits of files (--allow-large-images); true if it did.
void glint_decoder_allow_large(void);
bool glint_decoder_allows_large(void);

#ifdef __cplusplus
}
#endif

#endif
