// An OpenCL driver for tests that fails on request. It is PoCL, except for one function.
// Environment: FAULTY_REAL is the library of PoCL, FAULTY_KERNEL the name of a kernel, and
// FAULTY_WAY the fault when a program launches this kernel:
//   abort, crash, exit, hang   the process does this, after a word on stderr
//   garbage                    the launch succeeds and nothing is computed
//   refuse                     the launch fails
//   compile                    no program compiles, whatever the kernel
// NOLINTBEGIN(readability-*): signatures are OpenCL's
#include <CL/cl_icd.h>

#include <dlfcn.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct _cl_platform_id {
    cl_icd_dispatch *dispatch;
};
struct _cl_kernel {
    cl_icd_dispatch *dispatch;
};

static cl_icd_dispatch real;

static int is_way(const char *name)
{
    const char *way = getenv("FAULTY_WAY");
    return way != NULL && strcmp(way, name) == 0;
}

static CL_API_ENTRY cl_int CL_API_CALL enqueue(cl_command_queue queue, cl_kernel kernel,
                                               cl_uint dimensions, const size_t *offset,
                                               const size_t *global, const size_t *local,
                                               cl_uint wait_count, const cl_event *wait_list,
                                               cl_event *event)
{
    char name[128] = "";
    const char *faulty = getenv("FAULTY_KERNEL");
    real.clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, NULL);
    static int launches;
    const char *after = getenv("FAULTY_AFTER");
    if (faulty != NULL && strcmp(name, faulty) == 0 &&
        ++launches > (after != NULL ? atoi(after) : 0)) {
        if (is_way("abort") || is_way("crash") || is_way("exit") || is_way("hang")) {
            fprintf(stderr, "faulty driver: %s is too much for me\n", name);
        }
        if (is_way("abort")) {
            abort();
        }
        if (is_way("crash")) {
            raise(SIGSEGV);
        }
        if (is_way("exit")) {
            exit(5);
        }
        while (is_way("hang")) {
            sleep(1);
        }
        if (is_way("garbage")) {
            return CL_SUCCESS;
        }
        if (is_way("refuse")) {
            return CL_OUT_OF_RESOURCES;
        }
    }
    return real.clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, global, local, wait_count,
                                       wait_list, event);
}

static CL_API_ENTRY cl_int CL_API_CALL build(cl_program program, cl_uint count,
                                             const cl_device_id *devices, const char *options,
                                             void(CL_CALLBACK *notify)(cl_program, void *),
                                             void *user)
{
    return is_way("compile") ? CL_BUILD_PROGRAM_FAILURE
                             : real.clBuildProgram(program, count, devices, options, notify, user);
}

// Changes the table of functions in place, because all of PoCL's objects share it.
CL_API_ENTRY cl_int CL_API_CALL clIcdGetPlatformIDsKHR(cl_uint entries, cl_platform_id *platforms,
                                                       cl_uint *count)
{
    const char *path = getenv("FAULTY_REAL");
    void *library = path != NULL ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    void *(*find)(const char *) = NULL;
    if (library != NULL) {
        *(void **)&find = dlsym(library, "clGetExtensionFunctionAddress");
    }
    clIcdGetPlatformIDsKHR_fn get = NULL;
    if (find != NULL) {
        *(void **)&get = find("clIcdGetPlatformIDsKHR");
    }
    cl_platform_id first = NULL;
    if (get == NULL || get(1, &first, NULL) != CL_SUCCESS) {
        return CL_PLATFORM_NOT_FOUND_KHR;
    }
    if (first->dispatch->clEnqueueNDRangeKernel != enqueue) {
        real = *first->dispatch;
        first->dispatch->clEnqueueNDRangeKernel = enqueue;
        first->dispatch->clBuildProgram = build;
    }
    return get(entries, platforms, count);
}

CL_API_ENTRY void *CL_API_CALL clGetExtensionFunctionAddress(const char *name)
{
    void *function = NULL;
    if (strcmp(name, "clIcdGetPlatformIDsKHR") == 0) {
        *(clIcdGetPlatformIDsKHR_fn *)&function = clIcdGetPlatformIDsKHR;
    } else if (strcmp(name, "clGetPlatformInfo") == 0) {
        *(cl_int(CL_API_CALL **)(cl_platform_id, cl_platform_info, size_t, void *, size_t *)) &
            function = clGetPlatformInfo;
    }
    return function;
}

// The loader asks for this function by name before it has the table.
CL_API_ENTRY cl_int CL_API_CALL clGetPlatformInfo(cl_platform_id platform, cl_platform_info name,
                                                  size_t size, void *value, size_t *needed)
{
    return real.clGetPlatformInfo(platform, name, size, value, needed);
}
// NOLINTEND(readability-*)
