// Decoding one file, in a process that may die of it.
#ifndef GLINT_DECODER_DECODE_H
#define GLINT_DECODER_DECODE_H

#include "image/decoding.h"

#ifdef __cplusplus
extern "C" {
#endif

// Loads what decoding needs, once, before the process is divided.
void glint_decode_prepare(void);

// Decodes into the memory file `memory` and fills in the answer. Keeps no limits but that on the
// picture's size.
void glint_decode(const glint_decode_request *request, int memory, glint_decode_answer *answer);

#ifdef __cplusplus
}
#endif

#endif
