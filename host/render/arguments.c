// Sets the arguments of the kernels. See arguments.h.
#include "render/arguments.h"

#include "device/opencl_error.h"

glint_status glint_arguments_set(const struct glint_device *device, cl_kernel kernel,
                                 const glint_argument *arguments, size_t count, glint_error *error)
{
    cl_int code = CL_SUCCESS;
    for (size_t i = 0; code == CL_SUCCESS && i < count; i++) {
        code = clSetKernelArg(kernel, (cl_uint)i, arguments[i].size, arguments[i].value);
    }
    return glint_check_opencl(error, device, "setting a kernel's argument", code);
}
