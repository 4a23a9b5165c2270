// Sums up large arrays, on all cores.
#ifndef GLINT_ENVIRONMENT_CHECKSUM_H
#define GLINT_ENVIRONMENT_CHECKSUM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Sets *sum to a hash of `count` bytes (XXH3 of parts, then of their hashes). Returns false without
// memory.
bool glint_checksum(const void *bytes, size_t count, uint64_t *sum);

#endif
