// Allocation whose size arithmetic cannot overflow. See memory.h.
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

#define ALIGNMENT ((size_t)64)

bool glint_multiply(size_t a, size_t b, size_t *product)
{
    size_t result;
    if (__builtin_mul_overflow(a, b, &result)) {
        return false;
    }
    *product = result;
    return true;
}

void *glint_allocate(size_t count, size_t size)
{
    size_t bytes;
    if (!glint_multiply(count, size, &bytes) || bytes > (size_t)-1 - ALIGNMENT) {
        return NULL;
    }
    // aligned_alloc wants a multiple of the alignment.
    bytes = (bytes + ALIGNMENT) / ALIGNMENT * ALIGNMENT;
    void *memory = aligned_alloc(ALIGNMENT, bytes);
    if (memory != NULL) {
        memset(memory, 0, bytes);
    }
    return memory;
}
