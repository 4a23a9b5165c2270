// Defines glint_device with its OpenCL handles: for floors 4 and 5 only.
#ifndef GLINT_DEVICE_OPENCL_H
#define GLINT_DEVICE_OPENCL_H

#include "device/capabilities.h"

#include <CL/cl.h>

// A program that the device keeps for the next request (program.c), in a linked list.
typedef struct glint_built_program {
    char *options; // all that the program depends on, with the kernels' folder; owned
    cl_program program;
    struct glint_built_program *next;
} glint_built_program;

struct glint_device {
    cl_device_id id;
    cl_context context;
    cl_command_queue queue; // in order
    // For launches that do not depend on each other; out of order if the device can. The user waits
    // for earlier work.
    cl_command_queue launches;
    glint_capabilities capabilities;
    glint_built_program *programs; // owned, latest first
};

#endif
