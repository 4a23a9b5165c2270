// What a renderer's plan is put to work with: kernels, light and outputs. What other plans of the
// same scene needed is kept, so that changing back and forth between a few costs next to nothing.
// For this floor only.
#ifndef GLINT_RENDER_EQUIPMENT_H
#define GLINT_RENDER_EQUIPMENT_H

#include "base/status.h"
#include "device/opencl.h"
#include "render/pixels.h"
#include "render/plan.h"
#include "render/upload.h"

#include <stddef.h>
#include <stdint.h>

// Of as many plans; those that have not been used for the longest time then make way.
#define GLINT_KERNELS_KEPT 8

typedef struct glint_kernels {
    char *options;      // that they were built with, owned; NULL: none
    cl_kernel render;   // NULL: none
    cl_kernel vertices; // NULL where pixels are shaded
    uint64_t last_use;  // which of the equipment's it was; 0: none
} glint_kernels;

// What lights matte paint.
typedef enum glint_irradiance_kind {
    GLINT_IRRADIANCE_NOT_NEEDED,
    GLINT_IRRADIANCE_BY_MAP,
    GLINT_IRRADIANCE_BY_HARMONICS,
    GLINT_IRRADIANCE_KINDS,
} glint_irradiance_kind;

// Zero is valid.
typedef struct glint_equipment {
    glint_kernels kernels[GLINT_KERNELS_KEPT];
    uint64_t uses;                              // of kernels, so far
    glint_environment_memory environments[2];   // with float texels, with half texels
    cl_mem irradiances[GLINT_IRRADIANCE_KINDS]; // see kernels/layout.h
} glint_equipment;

struct glint_renderer;

// Finds or makes all that the renderer's plan and settings need, and hands it to the kernel. On
// failure the renderer has no kernel. Errors: as building kernels and uploading give.
glint_status glint_equip(struct glint_renderer *r, glint_error *error);

// Frees what is of the environment, to be made anew.
void glint_equipment_darken(glint_equipment *equipment);

// Bytes of all environments and irradiances.
size_t glint_equipment_light_bytes(const glint_equipment *equipment);

void glint_equipment_free(glint_equipment *equipment);

// What a frame of the renderer's settings is written into beside its pixels.
size_t glint_layers_bytes(const glint_settings *settings);
size_t glint_terms_bytes(const glint_settings *settings);
size_t glint_doubts_bytes(const glint_settings *settings);

#endif
