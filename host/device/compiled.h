// Knows which programs PoCL's cache holds compiled. PoCL does not tell. So glint leaves a
// stamp, an empty file, in the cache for each program whose kernels have been compiled. Source,
// options, device and driver make its name. A cache that is copied or shared brings its stamps
// along. A wrong stamp costs time, never a wrong frame: the driver then compiles.
#ifndef GLINT_DEVICE_COMPILED_H
#define GLINT_DEVICE_COMPILED_H

#include "device/opencl.h"
#include "device/program.h"

#include <stdbool.h>

// True if the program is stamped. Always false for other drivers than PoCL, for kernels from a
// folder, and if PoCL keeps no kernels.
bool glint_program_is_compiled(const struct glint_device *device,
                               const glint_program_request *request);

// Fails if the driver is PoCL and its cache cannot hold programs. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_programs_check_cache(const struct glint_device *device, glint_error *error);

// Stamps the program, after its kernels have run for the first time. Does nothing if it cannot.
void glint_program_stamp_compiled(const struct glint_device *device,
                                  const glint_program_request *request);

#endif
