// Defines an image in memory: rows of float pixels.
#ifndef GLINT_IMAGE_IMAGE_H
#define GLINT_IMAGE_IMAGE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Zero is valid: an image without pixels.
typedef struct glint_image {
    int width, height; // pixels, row 0 at the top, column 0 at the left
    int channels;      // 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA, premultiplied)
    float *pixels;     // [height][width][channels], owned; linear Rec.709 radiance
} glint_image;

// Makes an image of zeros. Fails if a size is not positive or if their product overflows.
glint_status glint_image_create(int width, int height, int channels, glint_image *image,
                                glint_error *error);
// Makes an image whose pixels are not set. *image is zero, or an image. Keeps its pixels if its
// shape fits and they are aligned. On failure *image is empty.
glint_status glint_image_reuse(int width, int height, int channels, glint_image *image,
                               glint_error *error);
void glint_image_free(glint_image *image);

// The first channel of pixel (x, y); the caller keeps x and y inside.
static inline float *glint_image_pixel(const glint_image *image, int x, int y)
{
    return image->pixels + ((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels;
}

// The colour of pixel (x, y), grey repeated.
static inline void glint_image_rgb(const glint_image *image, int x, int y, double rgb[3])
{
    const float *pixel = glint_image_pixel(image, x, y);
    const int step = image->channels >= 3;
    for (int c = 0; c < 3; c++) {
        rgb[c] = (double)pixel[c * step];
    }
}

// a + weight·(b − a), channel by channel.
static inline void glint_rgb_mix(const double a[3], const double b[3], double weight,
                                 double mixed[3])
{
    for (int c = 0; c < 3; c++) {
        mixed[c] = a[c] + weight * (b[c] - a[c]);
    }
}

// Counts the pixels with a NaN or infinite value, or whose values overflow when added.
size_t glint_image_count_nonfinite(const glint_image *image);

// Puts a picture behind a premultiplied picture: front + (1 − alpha)·back, linear, alpha 1. Where
// the front is opaque, the back does not count, not even if it is not finite. Both have the same
// size. The back's alpha is ignored: its colour is premultiplied.
void glint_image_put_behind(const glint_image *front, const glint_image *back);

static inline bool glint_image_has_alpha(const glint_image *image)
{
    return image->channels == 2 || image->channels == 4;
}

#ifdef __cplusplus
}
#endif

#endif
