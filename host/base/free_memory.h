// Tells how much memory this process can still get.
#ifndef GLINT_BASE_FREE_MEMORY_H
#define GLINT_BASE_FREE_MEMORY_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Returns the bytes that are left, the least of three numbers: the machine's free memory, the rest
// of the process's limit (ulimit -v), the rest of its cgroup's limit (a container, a batch job).
// UINT64_MAX: unknown.
uint64_t glint_free_memory(void);

#ifdef __cplusplus
}
#endif

#endif
