// OpenCL devices: which there are, what they can do, and opening one.
#ifndef GLINT_DEVICE_DEVICE_H
#define GLINT_DEVICE_DEVICE_H

#include "base/status.h"
#include "device/capabilities.h"

#include <stddef.h>

typedef struct glint_device glint_device; // opaque: context, queue, OpenCL's handles

// All devices of all platforms that can compile kernels: GPUs first, then CPUs, then others.
// `*list` is malloc'd, for free(). GLINT_DEVICE_FAILED, saying what to install, when there is no
// platform or no device.
glint_status glint_device_list(glint_capabilities **list, size_t *count, glint_error *error);

// `selector`: an index into the list ("0"), "cpu", "gpu", or a part of the device's or platform's
// name, any case; NULL: the first GPU, else the first CPU. A selector that fits none, or by name
// more than one, is refused with the list (GLINT_DEVICE_FAILED).
glint_status glint_device_open(const char *selector, glint_device **device, glint_error *error);

const glint_capabilities *glint_device_capabilities(const glint_device *device);

// NULL is allowed.
void glint_device_close(glint_device *device);

#endif
