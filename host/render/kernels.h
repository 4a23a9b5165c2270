// The compiled kernels of the last few plans, so that changing back and forth between them costs
// next to nothing. For this floor only.
#ifndef GLINT_RENDER_KERNELS_H
#define GLINT_RENDER_KERNELS_H

#include "base/status.h"
#include "device/opencl.h"
#include "render/plan.h"

#include <stdbool.h>
#include <stdint.h>

#define GLINT_KERNELS_KEPT 8

// Of one plan.
typedef struct glint_kernels {
    char *options;      // that they were built with, owned; NULL: none
    cl_kernel tiles;    // render_tiles
    cl_kernel vertices; // shade_vertices; NULL where pixels are shaded
    uint64_t last_use;  // which use of the cache it was; 0: none
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

// Finds the plan's kernels or builds them, in the place of those that have not been used for the
// longest time. *kernels is the cache's, until the next call. *are_new: they were built, and have
// not run yet. Errors: as glint_program_build; GLINT_OUT_OF_MEMORY.
glint_status glint_kernel_cache_get(glint_kernel_cache *cache, const glint_kernel_request *request,
                                    const glint_kernels **kernels, bool *are_new,
                                    glint_error *error);

// Bytes of the compiled program as the driver would hand it out; 0 where it does not.
size_t glint_kernels_program_bytes(const glint_kernels *kernels);

void glint_kernel_cache_free(glint_kernel_cache *cache);

#endif
