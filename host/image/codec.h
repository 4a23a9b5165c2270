// Starts glint-codec and sends it requests: glint's side of codec_messages.h.
#ifndef GLINT_IMAGE_CODEC_H
#define GLINT_IMAGE_CODEC_H

#include "base/status.h"
#include "image/codec_messages.h"

#include <limits.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_CODEC_PROGRAM "glint-codec"

// Sends the request with its memory file and waits for the answer; starts the codec if it does not
// run. `image` is a file with the bytes of an image to decode; −1: none. The caller keeps both
// files. If no answer comes in the request's time and a little more, *answer is a
// GLINT_CODEC_CHILD_DIED with status 0. Several threads may ask at once. Errors, if the codec could
// not be asked: GLINT_OUTPUT_FAILED for GLINT_ENCODE, GLINT_BAD_INPUT for all other work.
glint_status glint_codec_ask(const glint_codec_request *request, int results, int image,
                             glint_codec_answer *answer, glint_error *error);

// Finds the codec's program. False if it is not there.
bool glint_codec_find(char path[PATH_MAX]);

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
