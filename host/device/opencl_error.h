// OpenCL's errors as messages.
#ifndef GLINT_DEVICE_OPENCL_ERROR_H
#define GLINT_DEVICE_OPENCL_ERROR_H

#include "base/status.h"
#include "device/opencl.h"

// Fails with GLINT_DEVICE_FAILED and "device 'NAME': what: CL_NAME (−5)".
glint_status glint_fail_opencl(glint_error *error, const struct glint_device *device,
                               const char *what, cl_int code);

#endif
