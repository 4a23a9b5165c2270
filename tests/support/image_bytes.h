// Image files put together byte by byte from their formats' specifications: what the reader is
// judged by, and formats that the writer does not make.
#ifndef GLINT_TESTS_IMAGE_BYTES_H
#define GLINT_TESTS_IMAGE_BYTES_H

#include <stddef.h>
#include <stdint.h>

typedef struct image_bytes {
    unsigned char *bytes;
    size_t length, capacity;
} image_bytes;

void image_bytes_free(image_bytes *file);

// For files that are put together elsewhere. Numbers have their low byte first, or their high one.
void image_bytes_put(image_bytes *file, const void *bytes, size_t length);
void image_bytes_put_number(image_bytes *file, uint64_t number, int bytes);
void image_bytes_put_big(image_bytes *file, uint64_t number, int bytes);

// An uncompressed EXR of one part with float channels, names in alphabetical order. Windows are
// {x min, y min, x max, y max}. The value of a channel at a pixel is value(channel, x, y, context).
// envmap: −1 for no such attribute, 0 lat-long, 1 cube.
typedef struct exr_recipe {
    const char *const *names;
    int channels;
    int data[4], display[4];
    int envmap;
    float (*value)(int channel, int x, int y, void *context);
    void *context;
} exr_recipe;
image_bytes exr_bytes(const exr_recipe *recipe);

// An uncompressed little-endian TIFF of one strip. bits: 8 or 16; samples: 1 to 4, above 3 (or 1)
// with an extra sample of that kind (1 premultiplied alpha, 2 alpha beside). orientation 1 to 8.
typedef struct tiff_recipe {
    int width, height, samples, bits, extra, orientation;
    const uint16_t *codes; // [height][width][samples]
} tiff_recipe;
image_bytes tiff_bytes(const tiff_recipe *recipe);

// A Radiance picture without run lengths, four bytes a pixel, of fewer than 8 columns.
image_bytes hdr_bytes(int width, int height, const unsigned char *rgbe);

#endif
