// Independent pieces of work spread over the machine's cores.
#ifndef GLINT_BASE_PARALLEL_H
#define GLINT_BASE_PARALLEL_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The cores that this process may run on, which a container or taskset may have narrowed; 1 at
// least.
int glint_usable_cores(void);

// Calls body(index, context) once for each index below `count`, from several threads and in any
// order, and returns when all are done. What the body computes must depend on the index alone, so
// that the result is the same for any number of threads. Where no thread can be started the caller
// does the work.
void glint_parallel_for(size_t count, void (*body)(size_t index, void *context), void *context);

// The number of threads meant by `threads`: itself, at most 64, or with 0 one for each core that
// this process may run on.
size_t glint_parallel_threads(size_t threads);

// The same from glint_parallel_threads(threads) threads.
void glint_parallel_for_on(size_t threads, size_t count, void (*body)(size_t index, void *context),
                           void *context);

#ifdef __cplusplus
}
#endif

#endif
