// The pixels of a frame. See pixels.h.
#include "render/pixels.h"

#include "base/memory.h"
#include "device/opencl_error.h"
#include "render/upload.h"

#include <stdlib.h>

static size_t value_count(const glint_pixels *p)
{
    return (size_t)p->width * (size_t)p->height * 4;
}

glint_status glint_pixels_size(int width, int height, size_t scalar_bytes, size_t *bytes,
                               glint_error *error)
{
    size_t pixels;
    if (!glint_multiply((size_t)width, (size_t)height, &pixels) ||
        !glint_multiply(pixels, 4 * scalar_bytes, bytes)) {
        return glint_fail(error, GLINT_USAGE, "--size: %dx%d is too large", width, height);
    }
    return GLINT_OK;
}

static bool are_written_into_images(const glint_pixels *p)
{
    return p->device->capabilities.shares_memory && p->scalar_bytes == sizeof(float);
}

glint_status glint_pixels_resize(const struct glint_device *device, int width, int height,
                                 size_t scalar_bytes, glint_pixels *pixels, glint_error *error)
{
    *pixels = (glint_pixels){.device = device,
                             .width = width,
                             .height = height,
                             .scalar_bytes = scalar_bytes,
                             .own = pixels->own};
    const size_t bytes = glint_pixels_bytes(pixels);
    if (are_written_into_images(pixels) || glint_buffer_bytes(pixels->own) >= bytes) {
        return GLINT_OK;
    }
    glint_buffer_release(pixels->own);
    pixels->own = NULL;
    glint_status status =
        glint_buffer_create(device, "the frame", bytes, NULL, &pixels->own, error);
    if (status != GLINT_OK) {
        glint_pixels_free(pixels);
    }
    return status;
}

void glint_pixels_free(glint_pixels *pixels)
{
    glint_buffer_release(pixels->own);
    glint_buffer_release(pixels->around_image);
    *pixels = (glint_pixels){0};
}

size_t glint_pixels_bytes(const glint_pixels *pixels)
{
    return value_count(pixels) * pixels->scalar_bytes;
}

glint_status glint_pixels_begin(glint_pixels *pixels, glint_image *image, cl_mem *target,
                                glint_error *error)
{
    glint_status status = glint_image_reuse(pixels->width, pixels->height, 4, image, error);
    if (status != GLINT_OK) {
        return status;
    }
    if (!are_written_into_images(pixels)) {
        *target = pixels->own;
        return GLINT_OK;
    }
    cl_int code;
    pixels->around_image =
        clCreateBuffer(pixels->device->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                       glint_pixels_bytes(pixels), image->pixels, &code);
    *target = pixels->around_image;
    return code == CL_SUCCESS ? GLINT_OK
                              : glint_fail_opencl(error, pixels->device, "the frame", code);
}

static glint_status read_own(const glint_pixels *p, void *values, glint_error *error)
{
    cl_int code = clEnqueueReadBuffer(p->device->queue, p->own, CL_TRUE, 0, glint_pixels_bytes(p),
                                      values, 0, NULL, NULL);
    return code == CL_SUCCESS ? GLINT_OK
                              : glint_fail_opencl(error, p->device, "reading the frame", code);
}

// Where the buffer lies around the image nothing moves, but the host may only look at it once it is
// mapped.
static glint_status map_image(const glint_pixels *p, glint_error *error)
{
    cl_int code;
    void *mapped = clEnqueueMapBuffer(p->device->queue, p->around_image, CL_TRUE, CL_MAP_READ, 0,
                                      glint_pixels_bytes(p), 0, NULL, NULL, &code);
    if (code == CL_SUCCESS) {
        code = clEnqueueUnmapMemObject(p->device->queue, p->around_image, mapped, 0, NULL, NULL);
    }
    if (code == CL_SUCCESS) {
        code = clFinish(p->device->queue);
    }
    return code == CL_SUCCESS ? GLINT_OK
                              : glint_fail_opencl(error, p->device, "mapping the frame", code);
}

static glint_status read_rounded(const glint_pixels *p, float *rounded, glint_error *error)
{
    if (p->scalar_bytes == sizeof(float)) {
        return read_own(p, rounded, error);
    }
    double *exact = glint_allocate_unset(value_count(p), sizeof *exact);
    if (exact == NULL) {
        return glint_fail_memory(error, "the frame");
    }
    glint_status status = read_own(p, exact, error);
    for (size_t i = 0; status == GLINT_OK && i < value_count(p); i++) {
        rounded[i] = (float)exact[i];
    }
    free(exact);
    return status;
}

glint_status glint_pixels_end(glint_pixels *pixels, bool rendered, glint_image *image,
                              glint_error *error)
{
    glint_status status = GLINT_OK;
    if (rendered) {
        status = are_written_into_images(pixels) ? map_image(pixels, error)
                                                 : read_rounded(pixels, image->pixels, error);
    }
    glint_buffer_release(pixels->around_image);
    pixels->around_image = NULL;
    return status;
}

glint_status glint_pixels_exact(const glint_pixels *pixels, double *exact, glint_error *error)
{
    return read_own(pixels, exact, error);
}
