// Compiling the kernels.
#ifndef GLINT_DEVICE_PROGRAM_H
#define GLINT_DEVICE_PROGRAM_H

#include "base/status.h"
#include "device/opencl.h"

// Compiles kernels/render.cl with `options` and takes `name` from it. `kernel_dir` NULL: the
// embedded source; else the folder that holds render.cl, read now, so that kernels can be edited
// without building the program again. On a compile error `error->details` holds the build log,
// which names the kernel files and lines. Errors: GLINT_BAD_INPUT for a folder without render.cl,
// GLINT_DEVICE_FAILED.
glint_status glint_kernel_build(const struct glint_device *device, const char *kernel_dir,
                                const char *options, const char *name, cl_kernel *kernel,
                                glint_error *error);

#endif
