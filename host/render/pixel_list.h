// Makes lists of pixels for glint_settings.list.
#ifndef GLINT_RENDER_PIXEL_LIST_H
#define GLINT_RENDER_PIXEL_LIST_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

// A pixel's number in an image of at most GLINT_PIXEL_NUMBERS pixels, row by row.
#define GLINT_PIXEL_NUMBERS ((uint64_t)1 << 32)
static inline uint32_t glint_pixel_number(int width, int x, int y)
{
    return (uint32_t)y * (uint32_t)width + (uint32_t)x;
}

// A list of pixels in blocks of 4 × 4, so that packets of any shape hold neighbours. Zero is valid
// and empty.
typedef struct glint_pixel_list {
    uint32_t *numbers; // [rows][GLINT_LIST_COLUMNS], owned
    size_t count;      // pixels added so far
    int rows;
} glint_pixel_list;

// Makes room for `capacity` pixels. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_pixel_list_create(size_t capacity, glint_pixel_list *list, glint_error *error);
void glint_pixel_list_add(glint_pixel_list *list, uint32_t number);
// Fills unused entries with the first pixel.
void glint_pixel_list_fill(glint_pixel_list *list);
void glint_pixel_list_free(glint_pixel_list *list);

// The index in `numbers` of the pixel that was added after k others.
size_t glint_pixel_list_place(size_t k);

#endif
