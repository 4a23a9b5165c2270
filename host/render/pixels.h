// The pixels of a frame: where the device writes them, and how they come into an image.
#ifndef GLINT_RENDER_PIXELS_H
#define GLINT_RENDER_PIXELS_H

#include "base/status.h"
#include "device/opencl.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>

// A device that shares the host's memory writes a frame of floats straight into the image; any
// other one, and any one in double precision, into a buffer of its own, which is read back. Zero is
// valid.
typedef struct glint_pixels {
    const struct glint_device *device; // borrowed
    int width, height;
    size_t scalar_bytes; // of float or double
    cl_mem own;          // at least a frame's bytes, borrowed; not used where it is written into
                         // the image
    cl_mem around_image; // while a frame is rendered
} glint_pixels;

bool glint_pixels_are_written_into_images(const struct glint_device *device, size_t scalar_bytes);

// Makes *image RGBA of the frame's size (keeping its memory if it is that already) and says where
// the device has to write. glint_pixels_end must follow, and *image be left alone until then.
// Errors: GLINT_DEVICE_FAILED.
glint_status glint_pixels_begin(glint_pixels *pixels, glint_image *image, cl_mem *target,
                                glint_error *error);

// Brings the frame into the image if `rendered`, and ends what began.
glint_status glint_pixels_end(glint_pixels *pixels, bool rendered, glint_image *image,
                              glint_error *error);

// The last frame as the device computed it, [height][width][4] of double, into `exact`: of a frame
// in double precision only.
glint_status glint_pixels_exact(const glint_pixels *pixels, double *exact, glint_error *error);

#endif
