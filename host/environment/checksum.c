// Sums up large arrays. See checksum.h.
#include "environment/checksum.h"

#include "base/parallel.h"

#include <stdlib.h>
#include <xxhash.h>

#define PART ((size_t)4 << 20) // bytes that a thread sums up at a time

// The data that all threads share.
typedef struct summing {
    const char *bytes;
    size_t count;
    uint64_t *parts;
} summing;

static void sum_up_part(size_t index, void *context)
{
    const summing *shared = context;
    const size_t first = index * PART, left = shared->count - first;
    shared->parts[index] = XXH3_64bits(shared->bytes + first, left < PART ? left : PART);
}

bool glint_checksum(const void *bytes, size_t count, uint64_t *sum)
{
    const size_t parts = (count + PART - 1) / PART;
    summing shared = {bytes, count, malloc((parts + 1) * sizeof(uint64_t))};
    if (shared.parts == NULL) {
        return false;
    }
    glint_parallel_for(parts, sum_up_part, &shared);
    shared.parts[parts] = count;
    *sum = XXH3_64bits(shared.parts, (parts + 1) * sizeof(uint64_t));
    free(shared.parts);
    return true;
}
