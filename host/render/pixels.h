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
    cl_mem own;          // at least a frame's bytes; not used where it is written into the image
    cl_mem around_image; // while a frame is rendered
} glint_pixels;

// What a frame takes, in bytes. Fails with GLINT_USAGE where that cannot be counted.
glint_status glint_pixels_size(int width, int height, size_t scalar_bytes, size_t *bytes,
                               glint_error *error);

// For frames of another size or precision. A buffer that is large enough is kept, and one that is
// not needed, too: small frames in double precision and large ones take turns (see
// bound/error_grid.h). On failure *pixels is as zero. Errors: GLINT_DEVICE_FAILED.
glint_status glint_pixels_resize(const struct glint_device *device, int width, int height,
                                 size_t scalar_bytes, glint_pixels *pixels, glint_error *error);
void glint_pixels_free(glint_pixels *pixels);

// What a frame takes where the device writes it.
size_t glint_pixels_bytes(const glint_pixels *pixels);

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
