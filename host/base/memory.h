// Allocation whose size arithmetic cannot overflow.
#ifndef GLINT_BASE_MEMORY_H
#define GLINT_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_ALIGNMENT ((size_t)64) // a cache line, and what a zero-copy OpenCL buffer wants

// count × size zeroed bytes, aligned to GLINT_ALIGNMENT. NULL when the product overflows or memory
// is short. Release with free(). A count of 0 gives a pointer that can be freed.
void *glint_allocate(size_t count, size_t size);

// The same, but the bytes are not set: for large arrays that are written at once, from several
// threads.
void *glint_allocate_unset(size_t count, size_t size);

// Sets *product to a × b; false (and *product untouched) when that overflows.
bool glint_multiply(size_t a, size_t b, size_t *product);

#ifdef __cplusplus
}
#endif

#endif
