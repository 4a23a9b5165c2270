// Creates and fills buffers on the device. See buffer.h.
#include "device/buffer.h"

#include "device/opencl_error.h"

#include <stdlib.h>

#define MEBIBYTE 1048576.0
#define LEAST_BYTES ((size_t)16)
#define WAY_OUT "give a smaller frame or scene, or another --device"

static glint_status check_size(const struct glint_device *device, const glint_content *content,
                               glint_error *error)
{
    const glint_capabilities *c = &device->capabilities;
    if (content->bytes <= c->largest_allocation_bytes) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_DEVICE_LACKS,
                      "device '%s': %s needs %.0f MiB in one buffer and the device allows %.0f "
                      "(" WAY_OUT ")",
                      c->name, content->what, (double)content->bytes / MEBIBYTE,
                      (double)c->largest_allocation_bytes / MEBIBYTE);
}

glint_status glint_contents_check(const struct glint_device *device, const glint_content *contents,
                                  size_t count, size_t used, glint_error *error)
{
    double total = (double)used;
    for (size_t i = 0; i < count; i++) {
        TRY(check_size(device, &contents[i], error));
        total += (double)contents[i].bytes;
    }
    const glint_capabilities *c = &device->capabilities;
    if (total <= (double)c->memory_bytes) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_DEVICE_LACKS,
                      "device '%s': scene, environment and frame need %.0f MiB and it has %.0f "
                      "(" WAY_OUT ")",
                      c->name, total / MEBIBYTE, (double)c->memory_bytes / MEBIBYTE);
}

glint_status glint_buffer_create(const struct glint_device *device, const glint_content *content,
                                 cl_mem *buffer, glint_error *error)
{
    TRY(check_size(device, content, error));
    const size_t bytes = content->bytes > LEAST_BYTES ? content->bytes : LEAST_BYTES;
    cl_int code;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE, bytes, NULL, &code);
    if (code == CL_SUCCESS && content->data != NULL && content->bytes > 0) {
        code = glint_buffer_write(device, *buffer, content->bytes, content->data);
    }
    if (code != CL_SUCCESS) {
        glint_buffer_release(buffer);
    }
    return glint_check_opencl(error, device, content->what, code);
}

static bool can_share(const struct glint_device *device, const glint_content *content)
{
    return device->capabilities.shares_memory && content->bytes >= LEAST_BYTES;
}

glint_status glint_buffer_share(const struct glint_device *device, const glint_content *content,
                                cl_mem *buffer, glint_error *error)
{
    if (!can_share(device, content)) {
        return glint_buffer_create(device, content, buffer, error);
    }
    TRY(check_size(device, content, error));
    cl_int code;
    *buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR,
                             content->bytes, (void *)content->data, &code);
    return glint_check_opencl(error, device, content->what, code);
}

glint_status glint_buffer_hand_over(const struct glint_device *device, const glint_content *content,
                                    void **data, glint_shared_buffer *shared, glint_error *error)
{
    const glint_content given = {content->what, content->bytes, *data};
    TRY(glint_buffer_share(device, &given, &shared->buffer, error));
    if (can_share(device, &given)) {
        shared->kept = *data;
        *data = NULL;
    }
    return GLINT_OK;
}

void glint_shared_buffer_free(glint_shared_buffer *shared)
{
    glint_buffer_release(&shared->buffer);
    free(shared->kept);
    *shared = (glint_shared_buffer){0};
}

glint_status glint_buffer_fit(const struct glint_device *device, const glint_content *content,
                              cl_mem *buffer, glint_error *error)
{
    if (*buffer == NULL || glint_buffer_bytes(*buffer) < content->bytes) {
        glint_buffer_release(buffer);
        return glint_buffer_create(device, content, buffer, error);
    }
    if (content->data == NULL) {
        return GLINT_OK;
    }
    const cl_int code = glint_buffer_write(device, *buffer, content->bytes, content->data);
    return glint_check_opencl(error, device, content->what, code);
}

cl_int glint_buffer_read(const struct glint_device *device, cl_mem buffer, size_t bytes, void *data)
{
    return clEnqueueReadBuffer(device->queue, buffer, CL_TRUE, 0, bytes, data, 0, NULL, NULL);
}

cl_int glint_buffer_write(const struct glint_device *device, cl_mem buffer, size_t bytes,
                          const void *data)
{
    return clEnqueueWriteBuffer(device->queue, buffer, CL_TRUE, 0, bytes, data, 0, NULL, NULL);
}

size_t glint_buffer_bytes(cl_mem buffer)
{
    size_t bytes = 0;
    if (buffer != NULL) {
        clGetMemObjectInfo(buffer, CL_MEM_SIZE, sizeof bytes, &bytes, NULL);
    }
    return bytes;
}

void glint_buffer_release(cl_mem *buffer)
{
    if (*buffer != NULL) {
        clReleaseMemObject(*buffer);
    }
    *buffer = NULL;
}
