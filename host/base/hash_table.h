// Hash tables of items that the caller numbers, keeps, hashes and compares. Open addressing with
// linear probing. A table never grows.
#ifndef GLINT_BASE_HASH_TABLE_H
#define GLINT_BASE_HASH_TABLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define GLINT_NO_ITEM 0xFFFFFFFFu             // in an empty slot
#define GLINT_HASH_FACTOR 0x9E3779B97F4A7C15u // 2^64 over the golden ratio

// Zero is valid: no table.
typedef struct glint_hash_table {
    uint32_t *slots; // items' numbers; owned
    size_t mask;     // the number of slots in use, a power of two, less 1
    size_t room;     // the largest mask
} glint_hash_table;

// True if the item with the number `item` is the sought one.
typedef bool glint_is_sought(const void *sought, uint32_t item);

// Makes an empty table that is at most half full with `items` items. Returns false if memory is
// short.
bool glint_hash_table_create(size_t items, glint_hash_table *table);
void glint_hash_table_free(glint_hash_table *table);

// Empties the table for a number of different items, at most as many as it was made for. `items`
// may be larger if it counts equal ones, too. A table for few items is fast to empty.
void glint_hash_table_empty(glint_hash_table *table, size_t items);

// Returns the slot that holds the sought item, or else the empty slot where it belongs.
static inline uint32_t *glint_hash_table_slot(const glint_hash_table *table, uint64_t hash,
                                              glint_is_sought *is_sought, const void *sought)
{
    size_t slot = (size_t)(((hash ^ hash >> 32) * GLINT_HASH_FACTOR) >> 32) & table->mask;
    while (table->slots[slot] != GLINT_NO_ITEM && !is_sought(sought, table->slots[slot])) {
        slot = (slot + 1) & table->mask;
    }
    return &table->slots[slot];
}

// Mixes a word into a hash. glint_hash_table_slot spreads the result over all bits.
static inline uint64_t glint_hash_mix(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word) * GLINT_HASH_FACTOR;
    return hash ^ hash >> 29;
}

// Mixes floats into a hash. −0 and 0 give the same hash.
static inline uint64_t glint_hash_floats(uint64_t hash, const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const float value = values[i] + 0.0F;
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash = glint_hash_mix(hash, bits);
    }
    return hash;
}

#endif
