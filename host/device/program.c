// Compiles the kernels. See program.h. A driver's own cache, such as PoCL's, makes a second build
// of the same source and options fast.
#include "device/program.h"

#include "device/driver_cache.h"
#include "device/kernel_sources.h"
#include "device/opencl_error.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The build log, as a text for error->details; NULL if there is none.
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

// The program's text, and the options that it needs.
typedef struct source {
    const char *parts[2];
    cl_uint count;
    char include_option[4200];
} source;

// Finds the source. With a folder, each part is an #include, and the folder is the compiler's
// include path.
static glint_status find_source(const glint_program_request *request, source *found,
                                glint_error *error)
{
    const char *kernel_dir = request->kernel_dir;
    *found = (source){{glint_kernel_source, glint_probe_source}, request->with_probes ? 2 : 1, ""};
    if (kernel_dir == NULL) {
        return GLINT_OK;
    }
    char path[4096];
    if (strpbrk(kernel_dir, " \t\"'\\") != NULL) {
        // The build options are one string, which the driver splits at spaces.
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
    found->parts[0] = "#include \"render.cl\"\n";
    found->parts[1] = "#include \"probes.cl\"\n";
    snprintf(found->include_option, sizeof found->include_option, " -I %s", kernel_dir);
    return GLINT_OK;
}

static cl_program find_built(const struct glint_device *device, const char *options)
{
    for (const glint_built_program *p = device->programs; p != NULL; p = p->next) {
        if (strcmp(p->options, options) == 0) {
            clRetainProgram(p->program);
            return p->program;
        }
    }
    return NULL;
}

// Keeps a program. If memory is short, the program is built again at the next request.
static void keep_built(struct glint_device *device, const char *options, cl_program program)
{
    glint_built_program *kept = calloc(1, sizeof *kept);
    if (kept == NULL) {
        return;
    }
    kept->options = strdup(options);
    if (kept->options == NULL) {
        free(kept);
        return;
    }
    clRetainProgram(program);
    kept->program = program;
    kept->next = device->programs;
    device->programs = kept;
}

// False if the program has no kernels: a damaged cache may give such programs.
static bool has_kernels(cl_program program)
{
    size_t count = 0;
    return clGetProgramInfo(program, CL_PROGRAM_NUM_KERNELS, sizeof count, &count, NULL) !=
               CL_SUCCESS ||
           count > 0;
}

static glint_status compile(const struct glint_device *device, source *found, const char *options,
                            cl_program *program, glint_error *error)
{
    cl_int code;
    cl_program made =
        clCreateProgramWithSource(device->context, found->count, found->parts, NULL, &code);
    TRY(glint_check_opencl(error, device, "creating the kernels' program", code));
    code = clBuildProgram(made, 1, &device->id, options, NULL, NULL);
    if (code == CL_SUCCESS && !has_kernels(made)) {
        code = CL_INVALID_PROGRAM_EXECUTABLE;
    }
    if (code != CL_SUCCESS) {
        glint_status status =
            glint_fail_opencl(error, device, "compiling the kernels (the log follows)", code);
        if (error != NULL) {
            error->details = build_log(device, made);
        }
        clReleaseProgram(made);
        return status;
    }
    *program = made;
    return GLINT_OK;
}

// Compiles. Our own kernels compile, so a failure may mean that the driver's cache is damaged.
static glint_status compile_or_mend(const struct glint_device *device, source *found,
                                    const char *options, cl_program *program, glint_error *error)
{
    glint_driver_cache_begin();
    glint_status status = compile(device, found, options, program, error);
    if (status != GLINT_OK && found->include_option[0] == '\0' && glint_driver_cache_clean()) {
        if (error != NULL) {
            glint_error_free(error);
        }
        status = compile(device, found, options, program, error);
        if (status == GLINT_OK) {
            glint_driver_cache_is_mended();
        }
    }
    glint_driver_cache_end();
    return status;
}

// GPUs may divide and take roots less exactly if the option is missing. Then bits differ from a
// CPU's, and points on triangles lie farther off.
static const char *rounding_option(const struct glint_device *device)
{
    cl_device_fp_config config = 0;
    const bool can = !device->capabilities.is_cpu &&
                     clGetDeviceInfo(device->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof config, &config,
                                     NULL) == CL_SUCCESS &&
                     (config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    return can ? " -cl-fp32-correctly-rounded-divide-sqrt" : "";
}

glint_status glint_program_build(struct glint_device *device, const glint_program_request *request,
                                 cl_program *program, glint_error *error)
{
    *program = NULL;
    source found;
    char options[8192];
    TRY(find_source(request, &found, error));
    int length = snprintf(options, sizeof options, "%s%s%s", request->options,
                          rounding_option(device), found.include_option);
    if (length < 0 || (size_t)length >= sizeof options) {
        return glint_fail(error, GLINT_BAD_INPUT, "%s: the folder's name is too long",
                          request->kernel_dir);
    }
    *program = request->with_probes ? find_built(device, options) : NULL;
    if (*program != NULL) {
        return GLINT_OK;
    }
    TRY(compile_or_mend(device, &found, options, program, error));
    if (request->with_probes) {
        keep_built(device, options, *program);
    }
    return GLINT_OK;
}

glint_status glint_program_kernel(const struct glint_device *device, cl_program program,
                                  const char *name, cl_kernel *kernel, glint_error *error)
{
    cl_int code;
    *kernel = clCreateKernel(program, name, &code);
    return glint_check_opencl(error, device, "taking a kernel from its program", code);
}
