// Caches the compiled kernels of the last few plans. See kernels.h.
#include "render/kernels.h"

#include "device/compiled.h"
#include "device/driver_cache.h"
#include "device/program.h"
#include "render/launches.h"
#include "render/vertices.h"

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

static glint_program_request program_request(const glint_kernel_request *in, const char *options)
{
    return (glint_program_request){.kernel_dir = in->kernel_dir, .options = options};
}

static glint_status build(const glint_kernel_request *in, const char *options, glint_kernels *k,
                          glint_error *error)
{
    const glint_program_request request = program_request(in, options);
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
                          glint_kernel_kind kind, glint_kernels *k, glint_error *error)
{
    release(k);
    k->kind = kind;
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

// True if kernels with these options are ready in this process, or compiled in the driver's cache.
static bool are_compiled(glint_kernel_cache *cache, const glint_kernel_request *request,
                         const char *options)
{
    const glint_program_request program = program_request(request, options);
    return find(cache, options) != NULL || glint_program_is_compiled(request->device, &program);
}

// Chooses the kind of kernel, and writes its options.
static glint_kernel_kind choose(glint_kernel_cache *cache, const glint_kernel_request *request,
                                char options[GLINT_BUILD_OPTIONS_BYTES])
{
    const glint_kernel_kind general = glint_general_kernel_of(request->plan);
    glint_kernel_options(request->plan, GLINT_KERNEL_SPECIAL, options);
    if (request->choice == GLINT_KERNELS_SPECIAL || general == GLINT_KERNEL_SPECIAL ||
        (request->choice == GLINT_KERNELS_AUTO && are_compiled(cache, request, options))) {
        return GLINT_KERNEL_SPECIAL;
    }
    char of_general[GLINT_BUILD_OPTIONS_BYTES];
    glint_kernel_options(request->plan, general, of_general);
    if (request->choice == GLINT_KERNELS_AUTO && !are_compiled(cache, request, of_general)) {
        return GLINT_KERNEL_SPECIAL;
    }
    memcpy(options, of_general, GLINT_BUILD_OPTIONS_BYTES);
    return general;
}

glint_status glint_kernels_warm_up(const glint_kernel_request *request,
                                   const struct glint_launcher *launcher, glint_kernels *kernels,
                                   glint_error *error)
{
    if (kernels->have_run) {
        return GLINT_OK;
    }
    const glint_frame_record nothing = {0};
    glint_driver_cache_begin();
    glint_status status = glint_vertices_shade(launcher, &nothing, 0, error);
    if (status == GLINT_OK) {
        status = glint_launches_warm_up(launcher, error);
    }
    glint_driver_cache_end();
    if (status == GLINT_OK) {
        const glint_program_request program = program_request(request, kernels->options);
        glint_program_stamp_compiled(request->device, &program);
        kernels->have_run = true;
    }
    return status;
}

glint_status glint_kernels_compile(const glint_kernel_request *request, const char *options,
                                   bool *was_cached, glint_error *error)
{
    const glint_program_request program = program_request(request, options);
    TRY(glint_programs_check_cache(request->device, error));
    *was_cached = glint_program_is_compiled(request->device, &program);
    glint_kernels made = {0};
    glint_status status = renew(request, options, GLINT_KERNEL_SPECIAL, &made, error);
    if (status == GLINT_OK) {
        const glint_launcher launcher = {
            .device = request->device, .plan = request->plan, .kernels = &made};
        status = glint_kernels_warm_up(request, &launcher, &made, error);
    }
    release(&made);
    return status;
}

glint_status glint_kernel_cache_get(glint_kernel_cache *cache, const glint_kernel_request *request,
                                    glint_kernels **kernels, glint_error *error)
{
    char options[GLINT_BUILD_OPTIONS_BYTES];
    const glint_kernel_kind kind = choose(cache, request, options);
    glint_kernels *k = find(cache, options);
    if (k == NULL) {
        k = find_oldest(cache);
        TRY(renew(request, options, kind, k, error));
    }
    k->last_use = ++cache->uses;
    *kernels = k;
    return GLINT_OK;
}

void glint_kernel_cache_free(glint_kernel_cache *cache)
{
    for (size_t i = 0; i < GLINT_KERNELS_KEPT; i++) {
        release(&cache->kept[i]);
    }
}
