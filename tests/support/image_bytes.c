// Builds image files byte by byte. See image_bytes.h.
#include "support/image_bytes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void image_bytes_free(image_bytes *file)
{
    free(file->bytes);
    *file = (image_bytes){0};
}

void image_bytes_put(image_bytes *file, const void *bytes, size_t length)
{
    if (file->bytes == NULL || file->length + length > file->capacity) {
        file->capacity = 2 * (file->length + length);
        file->bytes = realloc(file->bytes, file->capacity);
        if (file->bytes == NULL) {
            abort();
        }
    }
    memcpy(file->bytes + file->length, bytes, length);
    file->length += length;
}

void image_bytes_put_number(image_bytes *file, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        unsigned char byte = (unsigned char)(number >> (8 * i));
        image_bytes_put(file, &byte, 1);
    }
}

void image_bytes_put_big(image_bytes *file, uint64_t number, int bytes)
{
    for (int i = bytes - 1; i >= 0; i--) {
        image_bytes_put_number(file, number >> (8 * i) & 0xff, 1);
    }
}

// ---- TIFF 6.0 -----------------------------------------------------------------------------------

static void put_entry(image_bytes *file, unsigned tag, unsigned type, unsigned count,
                      unsigned value)
{
    image_bytes_put_number(file, tag, 2);
    image_bytes_put_number(file, type, 2);
    image_bytes_put_number(file, count, 4);
    image_bytes_put_number(file, value, 4);
}

image_bytes tiff_bytes(const tiff_recipe *recipe)
{
    enum { SHORT = 3, LONG = 4 };
    unsigned entries = recipe->extra != 0 ? 11 : 10;
    image_bytes file = {0};
    unsigned samples = (unsigned)recipe->samples;
    unsigned after = 8 + 2 + 12 * entries + 4; // the bits of each sample, then the pixels
    unsigned values = (unsigned)(recipe->width * recipe->height) * samples;
    image_bytes_put(&file, "II*\0", 4);
    image_bytes_put_number(&file, 8, 4);
    image_bytes_put_number(&file, entries, 2);
    put_entry(&file, 256, SHORT, 1, (unsigned)recipe->width);
    put_entry(&file, 257, SHORT, 1, (unsigned)recipe->height);
    // Two values fit into the entry itself.
    unsigned both = (unsigned)recipe->bits | (unsigned)recipe->bits << 16;
    put_entry(&file, 258, SHORT, samples, samples > 2 ? after : both);
    put_entry(&file, 259, SHORT, 1, 1); // not compressed
    put_entry(&file, 262, SHORT, 1, samples > 2 ? 2 : 1);
    put_entry(&file, 273, LONG, 1, after + 8);
    put_entry(&file, 274, SHORT, 1, (unsigned)recipe->orientation);
    put_entry(&file, 277, SHORT, 1, samples);
    put_entry(&file, 278, SHORT, 1, (unsigned)recipe->height);
    put_entry(&file, 279, LONG, 1, values * (unsigned)recipe->bits / 8);
    if (recipe->extra != 0) {
        put_entry(&file, 338, SHORT, 1, (unsigned)recipe->extra);
    }
    image_bytes_put_number(&file, 0, 4);
    for (int i = 0; i < 4; i++) {
        image_bytes_put_number(&file, (uint64_t)recipe->bits, 2);
    }
    for (unsigned i = 0; i < values; i++) {
        image_bytes_put_number(&file, recipe->codes[i], recipe->bits / 8);
    }
    return file;
}

// ---- Radiance -----------------------------------------------------------------------------------

image_bytes hdr_bytes(int width, int height, const unsigned char *rgbe)
{
    image_bytes file = {0};
    char header[128];
    snprintf(header, sizeof header, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", height,
             width);
    image_bytes_put(&file, header, strlen(header));
    image_bytes_put(&file, rgbe, (size_t)(width * height) * 4);
    return file;
}
