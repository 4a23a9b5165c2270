// Caches the compiled kernels of the last few plans, so that changing between plans costs almost
// nothing. Used in this folder only.
#ifndef GLINT_RENDER_KERNELS_H
#define GLINT_RENDER_KERNELS_H

#include "base/status.h"
#include "device/opencl.h"
#include "render/plan.h"

#include <stdbool.h>
#include <stdint.h>

#define GLINT_KERNELS_KEPT 8

// The kernels of one plan.
typedef struct glint_kernels {
    char *options;      // build options, owned; NULL: this entry is empty
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
} glint_kernel_request;

// Finds or builds the plan's kernels. New kernels replace the least recently used entry. The cache
// owns *kernels, which are valid until the next call. *are_new: they were built now and have not
// run yet. Errors: as glint_program_build; GLINT_OUT_OF_MEMORY.
glint_status glint_kernel_cache_get(glint_kernel_cache *cache, const glint_kernel_request *request,
                                    const glint_kernels **kernels, bool *are_new,
                                    glint_error *error);

// Bytes of the compiled program as the driver returns it; 0 if the driver does not return it.
size_t glint_kernels_program_bytes(const glint_kernels *kernels);

void glint_kernel_cache_free(glint_kernel_cache *cache);

#endif
