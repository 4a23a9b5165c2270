// Makes lists of pixels. See pixel_list.h.
#include "render/pixel_list.h"

#include "base/memory.h"
#include "render/plan.h"

#include <stdlib.h>

#define BLOCK 4
#define BLOCK_PIXELS (BLOCK * BLOCK)

glint_status glint_pixel_list_create(size_t capacity, glint_pixel_list *list, glint_error *error)
{
    const size_t in_row_of_blocks = GLINT_LIST_COLUMNS * BLOCK;
    *list = (glint_pixel_list){0};
    list->rows = (int)((capacity + in_row_of_blocks - 1) / in_row_of_blocks * BLOCK);
    list->numbers = glint_allocate((size_t)list->rows * GLINT_LIST_COLUMNS, sizeof *list->numbers);
    return list->numbers != NULL ? GLINT_OK : glint_fail_memory(error, "a list of pixels");
}

size_t glint_pixel_list_place(size_t k)
{
    const size_t block = k / BLOCK_PIXELS, blocks_across = GLINT_LIST_COLUMNS / BLOCK;
    const size_t column = block % blocks_across * BLOCK + k % BLOCK;
    const size_t row = block / blocks_across * BLOCK + k % BLOCK_PIXELS / BLOCK;
    return row * GLINT_LIST_COLUMNS + column;
}

void glint_pixel_list_add(glint_pixel_list *list, uint32_t number)
{
    list->numbers[glint_pixel_list_place(list->count++)] = number;
}

void glint_pixel_list_fill(glint_pixel_list *list)
{
    for (size_t k = list->count; k < (size_t)list->rows * GLINT_LIST_COLUMNS; k++) {
        list->numbers[glint_pixel_list_place(k)] = list->numbers[0];
    }
}

void glint_pixel_list_free(glint_pixel_list *list)
{
    free(list->numbers);
    *list = (glint_pixel_list){0};
}
