// Creates buffers on the device: for floors 4 and 5 only.
#ifndef GLINT_DEVICE_BUFFER_H
#define GLINT_DEVICE_BUFFER_H

#include "base/status.h"
#include "device/opencl.h"

#include <stddef.h>

// The content of a buffer. Pointers are borrowed.
typedef struct glint_content {
    const char *what; // for messages: "the tree"
    size_t bytes;
    const void *data; // NULL: any content
} glint_content;

// Fails with GLINT_DEVICE_LACKS if one of the contents exceeds the device's limit, or if all
// together exceed its memory less `used` bytes.
glint_status glint_contents_check(const struct glint_device *device, const glint_content *contents,
                                  size_t count, size_t used, glint_error *error);

// Makes a buffer of at least 16 bytes. Errors: GLINT_DEVICE_FAILED, GLINT_DEVICE_LACKS; *buffer is
// then NULL.
glint_status glint_buffer_create(const struct glint_device *device, const glint_content *content,
                                 cl_mem *buffer, glint_error *error);

// A buffer that may lie in the host's memory. Zero is valid.
typedef struct glint_shared_buffer {
    cl_mem buffer;
    void *kept; // memory of the buffer, owned; NULL: the buffer is a copy
} glint_shared_buffer;

// Makes a buffer with *data, of content->bytes. On a device that shares the host's memory it uses
// *data itself, takes it over and sets *data to NULL. Else it copies. Errors: as
// glint_buffer_create.
glint_status glint_buffer_hand_over(const struct glint_device *device, const glint_content *content,
                                    void **data, glint_shared_buffer *shared, glint_error *error);
void glint_shared_buffer_free(glint_shared_buffer *shared);

// Makes a buffer with content->data, for kernels that only read it. On a device that shares the
// host's memory it uses the data itself, aligned to GLINT_ALIGNMENT. Else it copies. The data must
// stay unchanged while the buffer exists. Errors: as glint_buffer_create.
glint_status glint_buffer_share(const struct glint_device *device, const glint_content *content,
                                cl_mem *buffer, glint_error *error);

// Writes the content to *buffer. Makes a new buffer only if it is too small.
glint_status glint_buffer_fit(const struct glint_device *device, const glint_content *content,
                              cl_mem *buffer, glint_error *error);

// Read the first `bytes` of a buffer, or write them. The calls wait for the end.
cl_int glint_buffer_read(const struct glint_device *device, cl_mem buffer, size_t bytes,
                         void *data);
cl_int glint_buffer_write(const struct glint_device *device, cl_mem buffer, size_t bytes,
                          const void *data);

// The buffer's size in bytes; 0 for NULL.
size_t glint_buffer_bytes(cl_mem buffer);

// Releases the buffer and sets it to NULL. NULL is allowed.
void glint_buffer_release(cl_mem *buffer);

#endif
