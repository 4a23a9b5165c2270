// Holds the environment on the device: its texels and its irradiance, in the forms that the last
// few plans needed. Used in this folder only.
#ifndef GLINT_RENDER_LIGHT_H
#define GLINT_RENDER_LIGHT_H

#include "base/status.h"
#include "device/buffer.h"
#include "environment/environment.h"
#include "environment/half_texels.h"
#include "render/plan.h"

#include <stdbool.h>
#include <stddef.h>

// The source of light on matte paint.
typedef enum glint_irradiance_kind {
    GLINT_IRRADIANCE_NOT_NEEDED,
    GLINT_IRRADIANCE_BY_MAP,
    GLINT_IRRADIANCE_BY_HARMONICS,
    GLINT_IRRADIANCE_KINDS,
} glint_irradiance_kind;

// The buffers that a plan's kernels read. They are borrowed.
typedef struct glint_chosen_light {
    cl_mem environment, irradiance, lobes;
    int environment_edge;
    int irradiance_edge; // 0: no map
} glint_chosen_light;

// Zero is valid: no environment.
typedef struct glint_light {
    const struct glint_device *device;    // borrowed
    const glint_environment *environment; // borrowed
    glint_proxy proxy;                    // the environment's
    // Rounding error of half texels; valid if half_is_known.
    glint_half_rounding half;
    bool half_is_known;
    glint_shared_buffer texels[2];              // floats, halfs
    cl_mem irradiances[GLINT_IRRADIANCE_KINDS]; // see kernels/layout.h
    glint_shared_buffer lobes; // data of rough surfaces: albedos and cells; zero: none yet
    int cells_last;            // finest level of the cells
    bool knows_sheen;          // the lobes include the albedo of sheen
    glint_chosen_light chosen; // for the current plan
    double upload_ms;          // uploads of this environment
    double irradiance_ms;      // irradiance of this and of earlier environments
    double cells_ms;           // cells of this and of earlier environments
} glint_light;

// Replaces the environment; uploads nothing yet. The environment is borrowed as long as
// glint_light_choose is called.
void glint_light_set_environment(glint_light *light, const glint_environment *environment);

// True if the settings may choose half texels.
bool glint_light_may_be_half(const glint_settings *settings);

// Measures the rounding if the settings may choose half texels. Errors: as
// glint_half_rounding_measure.
glint_status glint_light_measure_half(glint_light *light, const glint_settings *settings,
                                      glint_error *error);

// Finds or makes the buffers that the plan reads. `without_frames`: no irradiance map is needed.
// Errors: GLINT_DEVICE_FAILED, GLINT_OUT_OF_MEMORY.
glint_status glint_light_choose(glint_light *light, const glint_plan *plan, bool without_frames,
                                glint_error *error);

// Bytes of all buffers.
size_t glint_light_bytes(const glint_light *light);

void glint_light_free(glint_light *light);

#endif
