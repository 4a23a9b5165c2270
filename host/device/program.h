// Compiles the kernels.
#ifndef GLINT_DEVICE_PROGRAM_H
#define GLINT_DEVICE_PROGRAM_H

#include "base/status.h"
#include "device/opencl.h"

#include <stdbool.h>

// What to compile, and how.
typedef struct glint_program_request {
    // NULL: the embedded source. Else a folder with render.cl, so that kernels can be edited
    // without building glint again.
    const char *kernel_dir;
    const char *options; // build options
    bool with_probes;    // add kernels/probes.cl
} glint_program_request;

// Compiles kernels/render.cl. Programs with probes are kept for later equal requests: self-tests
// ask for one many times, and even from a driver's cache it takes a second. The caller releases the
// program. On a compile error `error->details` holds the build log, which names the kernel files
// and lines. Errors: GLINT_BAD_INPUT for a folder without render.cl, GLINT_DEVICE_FAILED.
glint_status glint_program_build(struct glint_device *device, const glint_program_request *request,
                                 cl_program *program, glint_error *error);

// Gets the kernel of this name. Errors: GLINT_DEVICE_FAILED.
glint_status glint_program_kernel(const struct glint_device *device, cl_program program,
                                  const char *name, cl_kernel *kernel, glint_error *error);

#endif
