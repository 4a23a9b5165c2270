// Allocates memory; the arithmetic on sizes cannot overflow.
#ifndef GLINT_BASE_MEMORY_H
#define GLINT_BASE_MEMORY_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_ALIGNMENT ((size_t)64) // a cache line; enough for zero-copy OpenCL buffers

// Returns count × size zeroed bytes, aligned to GLINT_ALIGNMENT. NULL if the product overflows or
// memory is short. The caller frees them with free(). A count of 0 gives a pointer that can be
// freed.
void *glint_allocate(size_t count, size_t size);

// Allocates alike, but does not set the bytes. For large arrays that several threads fill at once.
void *glint_allocate_unset(size_t count, size_t size);

// Makes room for one more item in a growing array of `count` items: *items has *capacity of them,
// of `size` bytes, and may move. Returns false, and changes nothing, if memory is short.
bool glint_make_room(void **items, size_t count, size_t *capacity, size_t size);

// Sets *product to a × b. If the product overflows, returns false and leaves *product untouched.
bool glint_multiply(size_t a, size_t b, size_t *product);

#ifdef __cplusplus
}
#endif

#endif
