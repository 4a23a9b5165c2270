// How much memory this process can still get.
#ifndef GLINT_BASE_FREE_MEMORY_H
#define GLINT_BASE_FREE_MEMORY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Bytes, by what the machine has left, the limit of the process (ulimit -v), and that of its group
// (a container, a batch job). UINT64_MAX where nothing is known.
uint64_t glint_free_memory(void);

#ifdef __cplusplus
}
#endif

#endif
