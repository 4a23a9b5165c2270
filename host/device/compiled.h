// Knows which programs PoCL's cache holds compiled. PoCL does not tell. So glint leaves a mark in
// the cache for each program whose kernels have been compiled, named by source, options, device and
// driver. A cache that is copied or shared brings its marks along. A wrong mark costs time, never
// a wrong frame: the driver then compiles.
#ifndef GLINT_DEVICE_COMPILED_H
#define GLINT_DEVICE_COMPILED_H

#include "device/opencl.h"
#include "device/program.h"

#include <stdbool.h>

// True if the program is marked. Always false for other drivers than PoCL, for kernels from a
// folder, and if PoCL keeps no kernels.
bool glint_program_is_compiled(const struct glint_device *device,
                               const glint_program_request *request);

// Marks the program, after its kernels have run for the first time. Does nothing if it cannot.
void glint_program_mark_compiled(const struct glint_device *device,
                                 const glint_program_request *request);

#endif
