// Caches the compiled kernels of the last few plans. See kernels.h.
#include "render/kernels.h"

#include "device/program.h"

#include <stdlib.h>
#include <string.h>

static void release(glint_kernels *k)
{
    if (k->tiles != NULL) {
        clReleaseKernel(k->tiles);
    }
    if (k->vertices != NULL) {
        clReleaseKernel(k->vertices);
    }
    free(k->options);
    *k = (glint_kernels){0};
}

static glint_status build(const glint_kernel_request *in, const char *options, glint_kernels *k,
                          glint_error *error)
{
    const glint_program_request request = {.kernel_dir = in->kernel_dir, .options = options};
    cl_program program;
    TRY(glint_program_build(in->device, &request, &program, error));
    glint_status status =
        glint_program_kernel(in->device, program, "render_tiles", &k->tiles, error);
    if (status == GLINT_OK && glint_plan_shades_vertices(in->plan)) {
        status = glint_program_kernel(in->device, program, "shade_vertices", &k->vertices, error);
    }
    clReleaseProgram(program); // the kernels hold it
    return status;
}

// The kernels with these options; NULL if there are none.
static glint_kernels *find(glint_kernel_cache *cache, const char *options)
{
    for (size_t i = 0; i < GLINT_KERNELS_KEPT; i++) {
        glint_kernels *k = &cache->kept[i];
        if (k->options != NULL && strcmp(k->options, options) == 0) {
            return k;
        }
    }
    return NULL;
}

static glint_kernels *find_oldest(glint_kernel_cache *cache)
{
    glint_kernels *oldest = &cache->kept[0];
    for (size_t i = 1; i < GLINT_KERNELS_KEPT; i++) {
        oldest = cache->kept[i].last_use < oldest->last_use ? &cache->kept[i] : oldest;
    }
    return oldest;
}

static glint_status renew(const glint_kernel_request *request, const char *options,
                          glint_kernels *k, glint_error *error)
{
    release(k);
    k->options = strdup(options);
    if (k->options == NULL) {
        return glint_fail_memory(error, "a kernel's options");
    }
    const glint_status status = build(request, options, k, error);
    if (status != GLINT_OK) {
        release(k);
    }
    return status;
}

glint_status glint_kernel_cache_get(glint_kernel_cache *cache, const glint_kernel_request *request,
                                    const glint_kernels **kernels, bool *are_new,
                                    glint_error *error)
{
    char options[4096];
    glint_plan_build_options(request->plan, options, sizeof options);
    glint_kernels *k = find(cache, options);
    *are_new = k == NULL;
    if (*are_new) {
        k = find_oldest(cache);
        TRY(renew(request, options, k, error));
    }
    k->last_use = ++cache->uses;
    *kernels = k;
    return GLINT_OK;
}

size_t glint_kernels_program_bytes(const glint_kernels *kernels)
{
    cl_program program = NULL;
    size_t bytes = 0; // for the only device that it was built for
    if (clGetKernelInfo(kernels->tiles, CL_KERNEL_PROGRAM, sizeof program, &program, NULL) !=
            CL_SUCCESS ||
        clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof bytes, &bytes, NULL) !=
            CL_SUCCESS) {
        return 0;
    }
    return bytes;
}

void glint_kernel_cache_free(glint_kernel_cache *cache)
{
    for (size_t i = 0; i < GLINT_KERNELS_KEPT; i++) {
        release(&cache->kept[i]);
    }
}
