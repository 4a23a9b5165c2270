// Buffers on the device: for floors 4 and 5 only.
#ifndef GLINT_DEVICE_BUFFER_H
#define GLINT_DEVICE_BUFFER_H

#include "base/status.h"
#include "device/opencl.h"

#include <stddef.h>

// What a buffer holds. Pointers are borrowed.
typedef struct glint_content {
    const char *what; // for messages: "the tree"
    size_t bytes;
    const void *data; // NULL: whatever there is
} glint_content;

// Fails with GLINT_DEVICE_FAILED where one of the contents is larger than the device allows, or all
// of them together than its memory less `used` bytes.
glint_status glint_contents_check(const struct glint_device *device, const glint_content *contents,
                                  size_t count, size_t used, glint_error *error);

// A buffer of at least 16 bytes. Errors: GLINT_DEVICE_FAILED; *buffer is then NULL.
glint_status glint_buffer_create(const struct glint_device *device, const glint_content *content,
                                 cl_mem *buffer, glint_error *error);

// A buffer that may lie in memory of the host's. Zero is valid.
typedef struct glint_shared_buffer {
    cl_mem buffer;
    void *kept; // what it lies in, owned; NULL: it is a copy
} glint_shared_buffer;

// A buffer that holds *data, of content->bytes: a copy or, on a device that shares the host's
// memory, *data itself, which then is kept, and *data NULL. Errors likewise.
glint_status glint_buffer_hand_over(const struct glint_device *device, const glint_content *content,
                                    void **data, glint_shared_buffer *shared, glint_error *error);
void glint_shared_buffer_free(glint_shared_buffer *shared);

// A buffer that holds content->data, which must stay unchanged as long as the buffer is there: a
// copy or, on a device that shares the host's memory, the data itself, aligned to GLINT_ALIGNMENT.
// For kernels that only read it. Errors likewise.
glint_status glint_buffer_share(const struct glint_device *device, const glint_content *content,
                                cl_mem *buffer, glint_error *error);

// Makes *buffer large enough for the content and writes the data; one that is, is kept.
glint_status glint_buffer_fit(const struct glint_device *device, const glint_content *content,
                              cl_mem *buffer, glint_error *error);

// The first `bytes` of a buffer, and back. The call waits for the end.
cl_int glint_buffer_read(const struct glint_device *device, cl_mem buffer, size_t bytes,
                         void *data);
cl_int glint_buffer_write(const struct glint_device *device, cl_mem buffer, size_t bytes,
                          const void *data);

// What the buffer takes, 0 for NULL.
size_t glint_buffer_bytes(cl_mem buffer);

// Releases and forgets the buffer. NULL is allowed.
void glint_buffer_release(cl_mem *buffer);

#endif
