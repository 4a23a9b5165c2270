// Encodes one file in memory.
#ifndef GLINT_CODEC_ENCODE_H
#define GLINT_CODEC_ENCODE_H

#include "image/codec_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

// Encodes the job in the memory file `memory` (image/encoding.h), appends the encoded file to it,
// and fills in the answer.
void glint_encode(const glint_codec_request *request, int memory, glint_codec_answer *answer);

#ifdef __cplusplus
}
#endif

#endif
