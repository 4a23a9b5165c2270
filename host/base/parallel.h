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

#ifdef __cplusplus
}
#endif

#endif
