// Allocates the binary tree's memory. See binary_node.h.
#include "accel/binary_node.h"

#include <stdlib.h>

#define BLOCK_BYTES ((size_t)65536)
#define ALIGNMENT ((size_t)16)

typedef struct glint_arena_block {
    struct glint_arena_block *next;
    _Alignas(16) unsigned char bytes[];
} glint_arena_block;

void *glint_arena_take(glint_arena *arena, size_t bytes)
{
    const size_t capacity = BLOCK_BYTES - sizeof(glint_arena_block);
    bytes = (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (arena->blocks == NULL || capacity - arena->used < bytes) {
        glint_arena_block *block = malloc(BLOCK_BYTES);
        if (block == NULL) {
            return NULL;
        }
        block->next = arena->blocks;
        arena->blocks = block;
        arena->used = 0;
    }
    void *piece = arena->blocks->bytes + arena->used;
    arena->used += bytes;
    return piece;
}

void glint_arena_free(glint_arena *arena)
{
    while (arena->blocks != NULL) {
        glint_arena_block *next = arena->blocks->next;
        free(arena->blocks);
        arena->blocks = next;
    }
    *arena = (glint_arena){0};
}
