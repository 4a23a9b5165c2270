// Builds image files byte by byte from their formats' specifications, to test the reader
// independently of the writer, also with formats that glint does not write.
#ifndef GLINT_TESTS_IMAGE_BYTES_H
#define GLINT_TESTS_IMAGE_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct image_bytes {
    unsigned char *bytes;
    size_t length, capacity;
} image_bytes;

void image_bytes_free(image_bytes *file);

// Append to any file. put_number is little-endian, put_big is big-endian.
void image_bytes_put(image_bytes *file, const void *bytes, size_t length);
void image_bytes_put_number(image_bytes *file, uint64_t number, int bytes);
void image_bytes_put_big(image_bytes *file, uint64_t number, int bytes);

// An uncompressed EXR of one part with float channels, names in alphabetical order. Windows are {x
// min, y min, x max, y max}. value(channel, x, y, context) gives the value of a pixel. envmap: −1
// no attribute, 0 lat-long, 1 cube. The members after `context` may be NULL.
typedef struct exr_recipe {
    const char *const *names;
    int channels;
    int data[4], display[4];
    int envmap;
    float (*value)(int channel, int x, int y, void *context);
    void *context;
    const char *part;            // its name
    const float *chromaticities; // [8]: x and y of red, green, blue and white
    const int *steps;            // [channels]: a value at every so many pixels and rows
} exr_recipe;
image_bytes exr_bytes(const exr_recipe *recipe);

// An EXR of several parts, which must have names.
image_bytes exr_parts_bytes(const exr_recipe *parts, int count);

// An uncompressed little-endian TIFF of one strip. bits: 8 or 16; samples: 1 to 4; orientation: 1
// to 8. A fourth (or second) sample is an extra sample: 1 premultiplied alpha, 2 straight alpha.
typedef struct tiff_recipe {
    int width, height, samples, bits, extra, orientation;
    const uint16_t *codes; // [height][width][samples]
} tiff_recipe;
image_bytes tiff_bytes(const tiff_recipe *recipe);

// A baseline JPEG of 8 × 8 equal pixels, of `count` components. adobe: the colour transform that
// Adobe's marker names; −1: no marker.
image_bytes jpeg_bytes(const unsigned char *components, int count, int adobe);

#endif
