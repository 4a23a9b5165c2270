// Starts glint-codec and sends it requests: glint's side of codec_messages.h.
#ifndef GLINT_IMAGE_CODEC_H
#define GLINT_IMAGE_CODEC_H

#include "base/status.h"
#include "image/codec_messages.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_CODEC_PROGRAM "glint-codec"

// Sends the request and waits for the answer; starts the codec if it does not run. Sets
// files->answers; the caller keeps the other files. If no answer
// comes within `seconds` (0: for ever), *answer is a GLINT_CODEC_CHILD_DIED with status 0. Several
// threads may ask at once. Errors, if the codec could not be asked: GLINT_OUTPUT_FAILED for
// GLINT_ENCODE, GLINT_BAD_INPUT for all other work.
glint_status glint_codec_ask(const glint_codec_request *request, glint_codec_files *files,
                             uint32_t seconds, glint_codec_answer *answer, glint_error *error);

// Starts the codec, so that it loads its libraries while the caller works. The first request
// reports an error.
void glint_codec_start(void);

// Ends a codec that still loads its libraries. A codec that has loaded them ends by itself as soon
// as this process ends.
void glint_codec_abandon(void);

// Sets and gives the number of threads that work on a file. 0, the default, is one for each core.
void glint_codec_use_threads(int count);
int glint_codec_threads(void);

#ifdef __cplusplus
}
#endif

#endif
