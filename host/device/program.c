// Compiling the kernels. See program.h. The driver's own cache (PoCL's, for one) makes the second
// build of the same source with the same options fast.
#include "device/program.h"

#include "device/kernel_sources.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The build log, as a text for error->details; NULL where there is none.
static char *build_log(const struct glint_device *device, cl_program program)
{
    size_t size = 0;
    if (clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size) !=
        CL_SUCCESS) {
        return NULL;
    }
    char *log = calloc(size + 1, 1);
    if (log != NULL) {
        clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    }
    return log;
}

// With a folder, the source is one #include and the folder is the compiler's include path.
static glint_status source_of(const char *kernel_dir, const char **source, char *include_option,
                              size_t capacity, glint_error *error)
{
    *source = glint_kernel_source;
    include_option[0] = '\0';
    if (kernel_dir == NULL) {
        return GLINT_OK;
    }
    char path[4096];
    if (strpbrk(kernel_dir, " \t\"'\\") != NULL) {
        // The build options are one string, split at spaces by the driver.
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: a kernel folder's name may hold no spaces or quotes", kernel_dir);
    }
    int length = snprintf(path, sizeof path, "%s/render.cl", kernel_dir);
    if (length < 0 || (size_t)length >= sizeof path || access(path, R_OK) != 0) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%s: no readable render.cl there (name the folder that holds the "
                          "kernels)",
                          kernel_dir);
    }
    *source = "#include \"render.cl\"\n";
    snprintf(include_option, capacity, " -I %s", kernel_dir);
    return GLINT_OK;
}

glint_status glint_kernel_build(const struct glint_device *device, const char *kernel_dir,
                                const char *options, const char *name, cl_kernel *kernel,
                                glint_error *error)
{
    *kernel = NULL;
    const char *source;
    char all_options[8192], include_option[4200];
    glint_status status =
        source_of(kernel_dir, &source, include_option, sizeof include_option, error);
    if (status != GLINT_OK) {
        return status;
    }
    int length = snprintf(all_options, sizeof all_options, "%s%s", options, include_option);
    if (length < 0 || (size_t)length >= sizeof all_options) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: the folder's name is too long", kernel_dir);
    }
    cl_int code;
    cl_program program = clCreateProgramWithSource(device->context, 1, &source, NULL, &code);
    if (code != CL_SUCCESS) {
        return glint_fail_opencl(error, device, "creating the kernels' program", code);
    }
    code = clBuildProgram(program, 1, &device->id, all_options, NULL, NULL);
    if (code != CL_SUCCESS) {
        status = glint_fail_opencl(error, device, "compiling the kernels (the log follows)", code);
        if (error != NULL) {
            error->details = build_log(device, program);
        }
        goto cleanup;
    }
    *kernel = clCreateKernel(program, name, &code);
    if (code != CL_SUCCESS) {
        status = glint_fail_opencl(error, device, "taking the kernel from its program", code);
    }
cleanup:
    clReleaseProgram(program);
    return status;
}
