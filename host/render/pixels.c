// Transfers the pixels of a frame into an image. See pixels.h.
#include "render/pixels.h"

#include "base/memory.h"
#include "device/buffer.h"
#include "device/opencl_error.h"

#include <stdlib.h>

static size_t value_count(const glint_pixels *p)
{
    return (size_t)p->width * (size_t)p->height * 4;
}

static size_t byte_count(const glint_pixels *p)
{
    return value_count(p) * p->scalar_bytes;
}

bool glint_pixels_are_written_into_images(const struct glint_device *device, size_t scalar_bytes)
{
    return device->capabilities.shares_memory && scalar_bytes == sizeof(float);
}

static bool are_written_into_images(const glint_pixels *p)
{
    return glint_pixels_are_written_into_images(p->device, p->scalar_bytes);
}

glint_status glint_pixels_begin(glint_pixels *pixels, glint_image *image, cl_mem *target,
                                glint_error *error)
{
    TRY(glint_image_reuse(pixels->width, pixels->height, 4, image, error));
    if (!are_written_into_images(pixels)) {
        *target = pixels->own;
        return GLINT_OK;
    }
    cl_int code;
    pixels->around_image =
        clCreateBuffer(pixels->device->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                       byte_count(pixels), image->pixels, &code);
    *target = pixels->around_image;
    return glint_check_opencl(error, pixels->device, "the frame", code);
}

static glint_status read_own(const glint_pixels *p, void *values, glint_error *error)
{
    const cl_int code = glint_buffer_read(p->device, p->own, byte_count(p), values);
    return glint_check_opencl(error, p->device, "reading the frame", code);
}

// Maps the image for the host. The buffer already uses the image's memory, so nothing is copied,
// but OpenCL lets the host read it only after mapping.
static glint_status map_image(const glint_pixels *p, glint_error *error)
{
    cl_int code;
    void *mapped = clEnqueueMapBuffer(p->device->queue, p->around_image, CL_TRUE, CL_MAP_READ, 0,
                                      byte_count(p), 0, NULL, NULL, &code);
    if (code == CL_SUCCESS) {
        code = clEnqueueUnmapMemObject(p->device->queue, p->around_image, mapped, 0, NULL, NULL);
    }
    if (code == CL_SUCCESS) {
        code = clFinish(p->device->queue);
    }
    return glint_check_opencl(error, p->device, "mapping the frame", code);
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
    glint_buffer_release(&pixels->around_image);
    return status;
}

glint_status glint_pixels_exact(const glint_pixels *pixels, double *exact, glint_error *error)
{
    return read_own(pixels, exact, error);
}
