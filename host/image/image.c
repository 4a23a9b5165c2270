// Implements an image in memory. See image.h.
#include "image/image.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

// Allocates the pixels of `made`, whose other members are set. *image becomes it, or empty on
// failure.
static glint_status make(glint_image made, void *(*allocate)(size_t, size_t), glint_image *image,
                         glint_error *error)
{
    *image = (glint_image){0};
    if (made.width < 1 || made.height < 1 || made.channels < 1 || made.channels > 4) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "image: %d × %d pixels of %d channels make no image", made.width,
                          made.height, made.channels);
    }
    size_t pixels = 0, values = 0;
    if (glint_multiply((size_t)made.width, (size_t)made.height, &pixels) &&
        glint_multiply(pixels, (size_t)made.channels, &values)) {
        made.pixels = allocate(values, sizeof(float));
    }
    if (made.pixels == NULL) {
        return glint_fail_memory(error, "an image");
    }
    *image = made;
    return GLINT_OK;
}

glint_status glint_image_create(int width, int height, int channels, glint_image *image,
                                glint_error *error)
{
    return make((glint_image){width, height, channels, NULL}, glint_allocate, image, error);
}

glint_status glint_image_reuse(int width, int height, int channels, glint_image *image,
                               glint_error *error)
{
    if (image->pixels != NULL && image->width == width && image->height == height &&
        image->channels == channels && (uintptr_t)image->pixels % GLINT_ALIGNMENT == 0) {
        return GLINT_OK;
    }
    glint_image_free(image);
    return make((glint_image){width, height, channels, NULL}, glint_allocate_unset, image, error);
}

void glint_image_free(glint_image *image)
{
    free(image->pixels);
    *image = (glint_image){0};
}

void glint_image_put_behind(const glint_image *front, const glint_image *back)
{
    for (int y = 0; y < front->height; y++) {
        for (int x = 0; x < front->width; x++) {
            float *pixel = glint_image_pixel(front, x, y);
            const float open = 1 - pixel[3];
            double rgb[3];
            if (open > 0) {
                glint_image_rgb(back, x, y, rgb);
                for (int c = 0; c < 3; c++) {
                    pixel[c] += open * (float)rgb[c];
                }
            }
            pixel[3] = 1;
        }
    }
}

size_t glint_image_count_nonfinite(const glint_image *image)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    const size_t channels = (size_t)image->channels;
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        float sum = 0;
        for (size_t c = 0; c < channels; c++) {
            sum += image->pixels[channels * i + c];
        }
        count += isfinite(sum) ? 0 : 1;
    }
    return count;
}
