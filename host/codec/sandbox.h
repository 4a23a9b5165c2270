// Restricts the processes that read files from strangers, so that a file which takes one over gains
// nothing.
#ifndef GLINT_CODEC_SANDBOX_H
#define GLINT_CODEC_SANDBOX_H

#include "image/codec_messages.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Enters the sandbox for good. The process cannot start a process or program. It cannot open files
// for writing, or make, move or remove them; without `may_open` it cannot open files by name. It
// cannot connect, or reach other processes. Returns false if the system has no such filters; the
// limits hold anyway.
bool glint_sandbox_enter(bool may_open);

// Closes all descriptors from GLINT_CODEC_SOCKET on except the `count` given ones (−1: none). So a
// child cannot answer for another one.
void glint_sandbox_close_others(const int *kept, size_t count);

// Makes a crash leave no core file.
void glint_sandbox_leave_no_core(void);

// Limits this process to the memory and time for one file, and to few open files. `threads` is the
// number of threads that decode; 0: one for each core.
void glint_sandbox_limit(const glint_decode_limits *limits, int threads);

#ifdef __cplusplus
}
#endif

#endif
