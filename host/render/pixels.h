// Holds the pixels of a frame: chooses where the device writes them, and transfers them into an
// image.
#ifndef GLINT_RENDER_PIXELS_H
#define GLINT_RENDER_PIXELS_H

#include "base/status.h"
#include "device/opencl.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>

// A device that shares the host's memory writes a frame of floats directly into the image. Other
// devices, and all frames in double precision, use a buffer, which is read back. Zero is valid.
typedef struct glint_pixels {
    const struct glint_device *device; // borrowed
    int width, height;
    size_t scalar_bytes; // size of float or double
    // Buffer of at least a frame's size, borrowed. Not used if the device writes into the image.
    cl_mem own;
    cl_mem around_image; // buffer around the image, while a frame is rendered
} glint_pixels;

bool glint_pixels_are_written_into_images(const struct glint_device *device, size_t scalar_bytes);

// Makes *image an RGBA image of the frame's size, and keeps its memory if it is one already.
// *target is the buffer that the device must write to. Afterwards call glint_pixels_end, and do not
// touch *image before. Errors: GLINT_DEVICE_FAILED.
glint_status glint_pixels_begin(glint_pixels *pixels, glint_image *image, cl_mem *target,
                                glint_error *error);

// Transfers the frame into the image if it was `rendered`, and releases resources of
// glint_pixels_begin.
glint_status glint_pixels_end(glint_pixels *pixels, bool rendered, glint_image *image,
                              glint_error *error);

// Copies the last frame as the device computed it into `exact`: [height][width][4] of double. Only
// for frames in double precision.
glint_status glint_pixels_exact(const glint_pixels *pixels, double *exact, glint_error *error);

#endif
