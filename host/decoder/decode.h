// Decodes one file, in a process that a hostile file may kill.
#ifndef GLINT_DECODER_DECODE_H
#define GLINT_DECODER_DECODE_H

#include "image/decoding.h"

#ifdef __cplusplus
extern "C" {
#endif

// Loads the libraries for decoding, once, before the process forks.
void glint_decode_prepare(void);

// Decodes into the memory file `memory` and fills in the answer. Enforces only the limit on the
// picture's size.
void glint_decode(const glint_decode_request *request, int memory, glint_decode_answer *answer);

#ifdef __cplusplus
}
#endif

#endif
