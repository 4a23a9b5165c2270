// Lists OpenCL devices with their capabilities, and opens one.
#ifndef GLINT_DEVICE_DEVICE_H
#define GLINT_DEVICE_DEVICE_H

#include "base/status.h"
#include "device/capabilities.h"

#include <stddef.h>

typedef struct glint_device glint_device; // opaque: context, queues, OpenCL's handles

// glint_device_start_drivers starts a thread that loads the drivers, for a caller who opens a
// device later. A caller who then opens none must call glint_device_await_drivers, which joins the
// thread, before the process exits: exit handlers unload libraries. Only the main thread calls
// both, and glint_device_list and glint_device_open, which wait for the drivers.
void glint_device_start_drivers(void);
void glint_device_await_drivers(void);

// Lists all devices of all platforms that can compile kernels: GPUs first, then CPUs, then others.
// The caller frees `*list` with free(). Fails with GLINT_DEVICE_FAILED if there is no platform or
// no device; the message says what to install.
glint_status glint_device_list(glint_capabilities **list, size_t *count, glint_error *error);

// Opens a device. `selector` is an index into the list ("0"), "cpu", "gpu", or a part of the
// device's or platform's name, in any case. NULL: the first GPU, else the first CPU. If a selector
// fits no device, or a name fits several, the message lists the devices (GLINT_DEVICE_FAILED).
glint_status glint_device_open(const char *selector, glint_device **device, glint_error *error);

const glint_capabilities *glint_device_capabilities(const glint_device *device);

// NULL is allowed.
void glint_device_close(glint_device *device);

#endif
