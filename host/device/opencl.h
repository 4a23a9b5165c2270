// OpenCL's handles behind glint_device: for floors 4 and 5 only.
#ifndef GLINT_DEVICE_OPENCL_H
#define GLINT_DEVICE_OPENCL_H

#include "device/capabilities.h"

#include <CL/cl.h>

// A program that the device keeps for the next request (program.c); a list.
typedef struct glint_built_program {
    char *options; // all that it depends on: they name the kernels' folder too; owned
    cl_program program;
    struct glint_built_program *next;
} glint_built_program;

struct glint_device {
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;    // in order
    cl_command_queue launches; // out of order where the device can, for launches that do not depend
                               // on each other; whoever uses it waits for what went before
    glint_capabilities capabilities;
    glint_built_program *programs; // owned, the latest first
};

#endif
