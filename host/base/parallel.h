// Spreads independent pieces of work over the machine's cores.
#ifndef GLINT_BASE_PARALLEL_H
#define GLINT_BASE_PARALLEL_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The number of cores that this process may use, at least 1. A container or taskset may limit it.
int glint_usable_cores(void);

// Calls body(index, context) once for each index below `count`, from several threads and in any
// order. Returns when all calls are done. The results of `body` must depend on the index alone;
// they are then the same for any number of threads. If no thread can start, the caller does all the
// work.
void glint_parallel_for(size_t count, void (*body)(size_t index, void *context), void *context);

// The number of threads to start for the setting `threads`: `threads` itself, at most 64. For 0:
// one thread for each core that this process may use.
size_t glint_parallel_threads(size_t threads);

// Works like glint_parallel_for, on glint_parallel_threads(threads) threads.
void glint_parallel_for_on(size_t threads, size_t count, void (*body)(size_t index, void *context),
                           void *context);

#ifdef __cplusplus
}
#endif

#endif
