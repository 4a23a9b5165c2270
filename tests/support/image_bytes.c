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

// ---- JPEG: ITU-T T.81 ---------------------------------------------------------------------------

// Bits that wait for a whole byte.
typedef struct bit_writer {
    image_bytes *file;
    unsigned bits;
    int count;
} bit_writer;

static void put_bits(bit_writer *to, unsigned bits, int count)
{
    for (int i = count - 1; i >= 0; i--) {
        to->bits = to->bits << 1 | (bits >> i & 1);
        if (++to->count == 8) {
            image_bytes_put_big(to->file, to->bits & 0xff, 1);
            if ((to->bits & 0xff) == 0xff) {
                image_bytes_put_big(to->file, 0, 1); // no marker
            }
            to->count = 0;
        }
    }
}

// A block without detail: the category of its mean, the mean, and the end of the block.
static void put_block(bit_writer *to, int value)
{
    const int mean = 8 * (value - 128);
    int category = 0;
    while (abs(mean) >> category != 0) {
        category++;
    }
    put_bits(to, (unsigned)category, 4);
    put_bits(to, (unsigned)(mean < 0 ? mean - 1 : mean), category);
    put_bits(to, 0, 1);
}

static void put_frame(image_bytes *file, int count)
{
    image_bytes_put_big(file, 0xffc0, 2);
    image_bytes_put_big(file, (unsigned)(8 + 3 * count), 2);
    image_bytes_put_big(file, 8, 1);
    image_bytes_put_big(file, 8, 2);
    image_bytes_put_big(file, 8, 2);
    image_bytes_put_big(file, (unsigned)count, 1);
    for (int c = 1; c <= count; c++) {
        image_bytes_put_big(file, (unsigned)c << 16 | 0x1100, 3); // every pixel; table 0
    }
}

// Codes of four bits for the categories 0 to 11, and of one bit for the end of a block.
static void put_codes(image_bytes *file)
{
    static const unsigned char means[] = {0xff, 0xc4, 0, 31, 0, 0, 0, 0, 12, 0,  0,
                                          0,    0,    0, 0,  0, 0, 0, 0, 0,  0,  0,
                                          1,    2,    3, 4,  5, 6, 7, 8, 9,  10, 11};
    static const unsigned char details[22] = {0xff, 0xc4, 0, 20, 0x10, 1};
    image_bytes_put(file, means, sizeof means);
    image_bytes_put(file, details, sizeof details);
}

image_bytes jpeg_bytes(const unsigned char *components, int count, int adobe)
{
    image_bytes file = {0};
    image_bytes_put_big(&file, 0xffd8, 2);
    if (adobe >= 0) {
        image_bytes_put(&file,
                        "\xff\xee\0\x0e"
                        "Adobe\0\x64\0\0\0\0",
                        15);
        image_bytes_put_big(&file, (unsigned)adobe, 1);
    }
    image_bytes_put_big(&file, 0xffdb004300, 5);
    for (int i = 0; i < 64; i++) {
        image_bytes_put_big(&file, 1, 1);
    }
    put_frame(&file, count);
    put_codes(&file);
    image_bytes_put_big(&file, 0xffda, 2);
    image_bytes_put_big(&file, (unsigned)(6 + 2 * count), 2);
    image_bytes_put_big(&file, (unsigned)count, 1);
    for (int c = 1; c <= count; c++) {
        image_bytes_put_big(&file, (unsigned)c << 8, 2);
    }
    image_bytes_put_big(&file, 0x003f00, 3);
    bit_writer bits = {&file, 0, 0};
    for (int c = 0; c < count; c++) {
        put_block(&bits, components[c]);
    }
    put_bits(&bits, 0x7f, 7); // fills the last byte
    image_bytes_put_big(&file, 0xffd9, 2);
    return file;
}
