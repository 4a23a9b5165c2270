// Restricts a decoder, so that a file which takes it over gains nothing.
#ifndef GLINT_DECODER_SANDBOX_H
#define GLINT_DECODER_SANDBOX_H

#include "image/decoding.h"

#include <stdbool.h>

// Enters the sandbox for good. The process cannot start a process or program. It cannot open files
// for writing, or make, move or remove them. It cannot connect, or reach other processes. Returns
// false if the system has no such filters; the limits hold anyway.
bool glint_sandbox_enter(void);

// Limits this process to the memory and time for one file, and to few open files. `threads` is the
// number of threads that decode; 0: one for each core.
void glint_sandbox_limit(const glint_decode_limits *limits, int threads);

#endif
