// Decoding image files in another process. See decoding.h.
#ifndef GLINT_IMAGE_DECODER_H
#define GLINT_IMAGE_DECODER_H

#include "base/status.h"
#include "image/decoding.h"
#include "image/formats.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// What the decoder made of a file: values in a memory file, [height][width][channels] of code_bits,
// or of float. It is read and not mapped: the decoder may still change it, or cut it off.
typedef struct glint_stored {
    const char *path; // of the image file, borrowed
    glint_stored_facts facts;
    size_t value_bytes;
    size_t name_bytes; // all_channels: after the values, [channels] texts, each with its end
    int file;          // owned; −1: none
} glint_stored;

// Decodes the file. Errors: GLINT_BAD_INPUT with the file's name, also where the decoder crashed,
// or where the file would cost more than it may; GLINT_OUT_OF_MEMORY.
glint_status glint_decoder_run(const glint_image_source *source, bool all_channels,
                               glint_stored *stored, glint_error *error);

// The same within limits of the caller's.
glint_status glint_decoder_run_within(const glint_image_source *source, bool all_channels,
                                      const glint_decode_limits *limits, glint_stored *stored,
                                      glint_error *error);

// What a file of this size may cost, unless the limits are lifted.
glint_decode_limits glint_decoder_limits(uint64_t file_bytes);

// Decodes a mesh that stands in the memory file `file` (mesh_decoding.h), which stays the caller's.
// `name` stands for it in messages. *index_bytes gets the bytes of its 32-bit indices, from
// index_offset on; 0 on an error. A mesh can break the process that decodes it, so the caller must
// check the number against index_room, and all indices. Errors: GLINT_BAD_INPUT with the name,
// GLINT_OUT_OF_MEMORY.
glint_status glint_decoder_run_mesh(const char *name, const glint_decode_limits *limits, int file,
                                    uint64_t *index_bytes, glint_error *error);

void glint_stored_free(glint_stored *stored);

// Reads so many bytes from `offset` on. Errors: GLINT_BAD_INPUT where the decoder has cut them off.
glint_status glint_stored_read(const glint_stored *stored, size_t offset, void *to, size_t bytes,
                               glint_error *error);

// Starts the decoder, so that it gets ready beside the caller. An error shows at the first file.
void glint_decoder_start(void);

// How many threads decode a file: 0, as it begins, is one for each core.
void glint_decoder_use_threads(int count);

// Lifts the limits on what a file may cost (--allow-large-images).
void glint_decoder_allow_large(void);

#ifdef __cplusplus
}
#endif

#endif
