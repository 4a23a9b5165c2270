// Turns OpenCL's errors into messages.
#ifndef GLINT_DEVICE_OPENCL_ERROR_H
#define GLINT_DEVICE_OPENCL_ERROR_H

#include "base/status.h"
#include "device/opencl.h"

// Fails with GLINT_DEVICE_FAILED and "device 'NAME': what: CL_NAME (−5)".
glint_status glint_fail_opencl(glint_error *error, const struct glint_device *device,
                               const char *what, cl_int code);

// Returns GLINT_OK if `code` is CL_SUCCESS; else fails as above.
static inline glint_status glint_check_opencl(glint_error *error, const struct glint_device *device,
                                              const char *what, cl_int code)
{
    return code == CL_SUCCESS ? GLINT_OK : glint_fail_opencl(error, device, what, code);
}

#endif
