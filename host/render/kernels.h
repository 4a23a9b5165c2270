// Caches the compiled kernels of the last few plans, so that changing between plans costs almost
// nothing. Used in this folder only.
#ifndef GLINT_RENDER_KERNELS_H
#define GLINT_RENDER_KERNELS_H

#include "base/status.h"
#include "device/opencl.h"
#include "render/general.h"
#include "render/plan.h"

#include <stdbool.h>
#include <stdint.h>

#define GLINT_KERNELS_KEPT 8

struct glint_launcher; // launches.h

// The kernels of one plan, or general kernels.
typedef struct glint_kernels {
    char *options; // build options, owned; NULL: this entry is empty
    glint_kernel_kind kind;
    bool have_run;      // glint_kernels_warm_up was called
    cl_kernel tiles;    // render_tiles
    cl_kernel vertices; // shade_vertices; NULL if the plan shades pixels
    uint64_t last_use;  // number of the last use in the cache; 0: none
} glint_kernels;

// An LRU cache. Zero is valid.
typedef struct glint_kernel_cache {
    glint_kernels kept[GLINT_KERNELS_KEPT];
    uint64_t uses;
} glint_kernel_cache;

typedef struct glint_kernel_request {
    struct glint_device *device;
    const char *kernel_dir; // see device/program.h
    const glint_plan *plan;
    glint_kernel_choice choice;
} glint_kernel_request;

// Finds or builds kernels for the plan, special or general as the request's choice says. New
// kernels replace the least recently used entry. The cache owns *kernels, which are valid until the
// next call. Kernels that were built now have not run yet. Errors: as glint_program_build;
// GLINT_OUT_OF_MEMORY.
glint_status glint_kernel_cache_get(glint_kernel_cache *cache, const glint_kernel_request *request,
                                    glint_kernels **kernels, glint_error *error);

// Runs the launcher's kernels once, over no pixels, by which the driver compiles all of them. Does
// nothing if they have run. Errors: GLINT_DEVICE_FAILED.
glint_status glint_kernels_warm_up(const glint_kernel_request *request,
                                   const struct glint_launcher *launcher, glint_kernels *kernels,
                                   glint_error *error);

// Compiles kernels with these build options. Of the plan, only the packets' width and the shading
// count. *was_cached: the driver's cache held them. Errors: as glint_kernel_cache_get;
// GLINT_OUTPUT_FAILED if the driver's cache cannot hold them.
glint_status glint_kernels_compile(const glint_kernel_request *request, const char *options,
                                   bool *was_cached, glint_error *error);

void glint_kernel_cache_free(glint_kernel_cache *cache);

#endif
