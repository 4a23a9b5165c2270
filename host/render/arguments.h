// Sets the arguments of the kernels from the lists in kernels/arguments.h. Used in this folder
// only.
#ifndef GLINT_RENDER_ARGUMENTS_H
#define GLINT_RENDER_ARGUMENTS_H

#include "base/status.h"
#include "device/opencl.h"
#include "kernels/arguments.h"

#include <stddef.h>

#define GLINT_BUFFER_MEMBER(type, name) cl_mem name;

// The buffers of the scene, and the buffers that a frame is written to. All are borrowed.
typedef struct glint_scene_arguments {
    GLINT_SCENE_ARGUMENTS(GLINT_BUFFER_MEMBER)
} glint_scene_arguments;

typedef struct glint_output_arguments {
    GLINT_OUTPUT_ARGUMENTS(GLINT_BUFFER_MEMBER)
} glint_output_arguments;

typedef struct glint_argument {
    size_t size;
    const void *value;
} glint_argument;

// Sets all arguments of a kernel, in order. Errors: GLINT_DEVICE_FAILED.
glint_status glint_arguments_set(const struct glint_device *device, cl_kernel kernel,
                                 const glint_argument *arguments, size_t count, glint_error *error);

#endif
