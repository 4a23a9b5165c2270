// Allocates memory; the arithmetic on sizes cannot overflow. See memory.h.
#include "base/memory.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define PAGE_BYTES ((uintptr_t)4096)
#define HUGE_BYTES ((size_t)1 << 22) // from this size on large pages pay

bool glint_multiply(size_t a, size_t b, size_t *product)
{
    size_t result;
    if (__builtin_mul_overflow(a, b, &result)) {
        return false;
    }
    *product = result;
    return true;
}

void *glint_allocate_unset(size_t count, size_t size)
{
    size_t bytes;
    if (!glint_multiply(count, size, &bytes) || bytes > (size_t)-1 - GLINT_ALIGNMENT) {
        return NULL;
    }
    // aligned_alloc requires a multiple of the alignment.
    bytes = (bytes + GLINT_ALIGNMENT) / GLINT_ALIGNMENT * GLINT_ALIGNMENT;
    void *memory = aligned_alloc(GLINT_ALIGNMENT, bytes);
#ifdef MADV_HUGEPAGE
    // Ask for large pages, because the first touch of each page costs time in the operating
    // system's kernel. With large pages the tree of a million triangles is built in a tenth less
    // time. The system may refuse.
    if (memory != NULL && bytes >= HUGE_BYTES) {
        uintptr_t first = ((uintptr_t)memory + PAGE_BYTES - 1) / PAGE_BYTES * PAGE_BYTES;
        uintptr_t last = ((uintptr_t)memory + bytes) / PAGE_BYTES * PAGE_BYTES;
        (void)madvise((void *)first, last - first, MADV_HUGEPAGE);
    }
#endif
    return memory;
}

void *glint_allocate(size_t count, size_t size)
{
    void *memory = glint_allocate_unset(count, size);
    if (memory != NULL) {
        memset(memory, 0, count * size);
    }
    return memory;
}

bool glint_make_room(void **items, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity) {
        return true;
    }
    const size_t more = *capacity == 0 ? 16 : 2 * *capacity;
    size_t bytes;
    void *grown = glint_multiply(more, size, &bytes) ? realloc(*items, bytes) : NULL;
    if (grown == NULL) {
        return false;
    }
    *items = grown;
    *capacity = more;
    return true;
}
