// Writes a picture as PNG. See write_png.h.
#include "write_png.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK_CAPACITY = 65535 };
enum { ZLIB_HEADER = 2, BLOCK_HEADER = 5, CHECKSUM = 4 };

// Big-endian.
static void set_word(unsigned char bytes[4], uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (unsigned char)(value >> (24 - 8 * i) & 0xff);
    }
}

static uint32_t continue_crc(uint32_t crc, const void *data, size_t count)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (int bit = 0; bit < 8; bit++) {
            crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
        }
    }
    return crc;
}

static uint32_t adler32(const unsigned char *bytes, size_t count)
{
    uint32_t low = 1, high = 0;
    for (size_t i = 0; i < count; i++) {
        low = (low + bytes[i]) % 65521;
        high = (high + low) % 65521;
    }
    return high << 16 | low;
}

static void write_chunk(FILE *file, const char *type, const unsigned char *data, size_t count)
{
    unsigned char length[4], checksum[4];
    set_word(length, (uint32_t)count);
    set_word(checksum, ~continue_crc(continue_crc(0xffffffffu, type, 4), data, count));
    fwrite(length, 1, 4, file);
    fwrite(type, 1, 4, file);
    if (count > 0) {
        fwrite(data, 1, count, file);
    }
    fwrite(checksum, 1, 4, file);
}

// Writes rows of texels, each after a byte for "no filter".
static void draw_rows(const picture *p, unsigned char *bytes)
{
    for (int row = 0; row < p->size; row++) {
        *bytes++ = 0;
        for (int column = 0; column < p->size; column++) {
            double value[4] = {0};
            p->draw((column + 0.5) / p->size, (row + 0.5) / p->size, value);
            for (int k = 0; k < p->channels; k++) {
                // Round to the grid of mesh_snap first: then a value half way between two bytes
                // rounds the same everywhere.
                *bytes++ = (unsigned char)floor(255 * mesh_snap(value[k]) + 0.5);
            }
        }
    }
}

static void write_chunks(const picture *p, size_t size, FILE *file)
{
    static unsigned char data[ZLIB_HEADER + BLOCK_HEADER + BLOCK_CAPACITY + CHECKSUM];
    const unsigned char low = (unsigned char)(size & 0xff), high = (unsigned char)(size >> 8);
    // zlib header: deflate, no dictionary. Block header: last block, stored, its length and the
    // complement of the length.
    const unsigned char start[ZLIB_HEADER + BLOCK_HEADER] = {
        0x78, 0x01, 1, low, high, (unsigned char)(low ^ 0xff), (unsigned char)(high ^ 0xff)};
    unsigned char *rows = data + sizeof start;
    memcpy(data, start, sizeof start);
    draw_rows(p, rows);
    set_word(rows + size, adler32(rows, size));

    unsigned char header[13] = {[8] = 8, [9] = p->channels == 4 ? 6 : 2};
    set_word(header, (uint32_t)p->size);
    set_word(header + 4, (uint32_t)p->size);
    fwrite("\x89PNG\r\n\x1a\n", 1, 8, file);
    write_chunk(file, "IHDR", header, sizeof header);
    write_chunk(file, "IDAT", data, sizeof start + size + CHECKSUM);
    write_chunk(file, "IEND", NULL, 0);
}

glint_status write_png(const picture *p, const char *path, glint_error *error)
{
    const size_t size = (size_t)p->size * (1 + (size_t)(p->size * p->channels));
    if (size > BLOCK_CAPACITY) {
        return glint_fail(error, GLINT_MISMATCH, "%s: more than %d bytes of texels", path,
                          BLOCK_CAPACITY);
    }
    FILE *file = fopen(path, "wb");
    if (file == NULL) {
        return glint_fail(error, GLINT_OUTPUT_FAILED, "%s: %s", path, strerror(errno));
    }
    write_chunks(p, size, file);
    bool failed = ferror(file) != 0;
    failed = fclose(file) != 0 || failed;
    return failed ? glint_fail(error, GLINT_OUTPUT_FAILED, "%s: cannot be written", path)
                  : GLINT_OK;
}
