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

// All three formats are little-endian.
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

static void put_float(image_bytes *file, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    image_bytes_put_number(file, bits, 4);
}

static void put_text(image_bytes *file, const char *text)
{
    image_bytes_put(file, text, strlen(text) + 1);
}

// ---- EXR: openexr.com, "OpenEXR File Layout" ----------------------------------------------------

static void put_attribute(image_bytes *file, const char *name, const char *type, uint32_t size)
{
    put_text(file, name);
    put_text(file, type);
    image_bytes_put_number(file, size, 4);
}

static void put_window(image_bytes *file, const char *name, const int window[4])
{
    put_attribute(file, name, "box2i", 16);
    for (int i = 0; i < 4; i++) {
        image_bytes_put_number(file, (uint64_t)(int64_t)window[i], 4);
    }
}

static void put_exr_header(image_bytes *file, const exr_recipe *recipe)
{
    image_bytes_put_number(file, 20000630, 4);
    image_bytes_put_number(file, 2, 4);
    uint32_t size = 1;
    for (int c = 0; c < recipe->channels; c++) {
        size += (uint32_t)strlen(recipe->names[c]) + 1 + 16;
    }
    put_attribute(file, "channels", "chlist", size);
    for (int c = 0; c < recipe->channels; c++) {
        put_text(file, recipe->names[c]);
        image_bytes_put_number(file, 2, 4); // float
        image_bytes_put_number(file, 0, 4);
        image_bytes_put_number(file, 1, 4); // sampled at every pixel
        image_bytes_put_number(file, 1, 4);
    }
    image_bytes_put_number(file, 0, 1);
    put_attribute(file, "compression", "compression", 1);
    image_bytes_put_number(file, 0, 1);
    put_window(file, "dataWindow", recipe->data);
    put_window(file, "displayWindow", recipe->display);
    if (recipe->envmap >= 0) {
        put_attribute(file, "envmap", "envmap", 1);
        image_bytes_put_number(file, (uint64_t)recipe->envmap, 1);
    }
    put_attribute(file, "lineOrder", "lineOrder", 1);
    image_bytes_put_number(file, 0, 1);
    put_attribute(file, "pixelAspectRatio", "float", 4);
    put_float(file, 1.0f);
    put_attribute(file, "screenWindowCenter", "v2f", 8);
    put_float(file, 0.0f);
    put_float(file, 0.0f);
    put_attribute(file, "screenWindowWidth", "float", 4);
    put_float(file, 1.0f);
    image_bytes_put_number(file, 0, 1);
}

image_bytes exr_bytes(const exr_recipe *recipe)
{
    image_bytes file = {0};
    put_exr_header(&file, recipe);
    int width = recipe->data[2] - recipe->data[0] + 1,
        height = recipe->data[3] - recipe->data[1] + 1;
    uint64_t line = (uint64_t)width * (uint64_t)recipe->channels * 4;
    uint64_t first = file.length + 8 * (uint64_t)height;
    for (int y = 0; y < height; y++) {
        image_bytes_put_number(&file, first + (uint64_t)y * (line + 8), 8);
    }
    for (int y = 0; y < height; y++) {
        image_bytes_put_number(&file, (uint64_t)(int64_t)(recipe->data[1] + y), 4);
        image_bytes_put_number(&file, line, 4);
        for (int c = 0; c < recipe->channels; c++) {
            for (int x = 0; x < width; x++) {
                put_float(&file, recipe->value(c, recipe->data[0] + x, recipe->data[1] + y,
                                               recipe->context));
            }
        }
    }
    return file;
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
