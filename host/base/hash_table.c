// Makes and empties hash tables. See hash_table.h.
#include "base/hash_table.h"

#include "base/memory.h"

#include <stdlib.h>

static size_t mask_for(size_t items)
{
    size_t mask = 15;
    while (mask < 2 * items) {
        mask = 2 * mask + 1;
    }
    return mask;
}

bool glint_hash_table_create(size_t items, glint_hash_table *table)
{
    const size_t mask = mask_for(items);
    *table = (glint_hash_table){.slots = glint_allocate_unset(mask + 1, sizeof *table->slots),
                                .room = mask};
    if (table->slots == NULL) {
        return false;
    }
    glint_hash_table_empty(table, items);
    return true;
}

void glint_hash_table_empty(glint_hash_table *table, size_t items)
{
    const size_t mask = mask_for(items);
    table->mask = mask < table->room ? mask : table->room;
    memset(table->slots, 0xFF, (table->mask + 1) * sizeof *table->slots);
}

void glint_hash_table_free(glint_hash_table *table)
{
    free(table->slots);
    *table = (glint_hash_table){0};
}
