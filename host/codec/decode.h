// Decodes one file, in a process that a hostile file may kill.
#ifndef GLINT_CODEC_DECODE_H
#define GLINT_CODEC_DECODE_H

#include "image/codec_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

// Loads the libraries, once, before the process forks.
void glint_codec_prepare(void);

// Sets the number of threads for a file: 0 is one for each core, 1 the caller's thread alone.
void glint_codec_set_threads(int threads);

// Decodes into the memory file `memory` and fills in the answer. Enforces only the limit on the
// picture's size.
void glint_decode(const glint_codec_request *request, int memory, glint_codec_answer *answer);

#ifdef __cplusplus
}
#endif

#endif
