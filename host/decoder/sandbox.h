// What a decoder may do, so that a file which takes it over gains nothing.
#ifndef GLINT_DECODER_SANDBOX_H
#define GLINT_DECODER_SANDBOX_H

#include "image/decoding.h"

#include <stdbool.h>

// For good: no process or program can be started, no file opened for writing, made, moved or
// removed, no connection made, no other process reached. False where the system does not know such
// filters: the limits hold all the same.
bool glint_sandbox_enter(void);

// Limits this process to what one file may cost of memory and time, and to few open files.
// `threads`: how many decode; 0: one for each core.
void glint_sandbox_limit(const glint_decode_limits *limits, int threads);

#endif
