// The environment on the device: its texels and its irradiance, as the last few plans wanted them.
// For this floor only.
#ifndef GLINT_RENDER_LIGHT_H
#define GLINT_RENDER_LIGHT_H

#include "base/status.h"
#include "device/buffer.h"
#include "environment/environment.h"
#include "environment/half_texels.h"
#include "render/plan.h"

#include <stdbool.h>
#include <stddef.h>

// What lights matte paint.
typedef enum glint_irradiance_kind {
    GLINT_IRRADIANCE_NOT_NEEDED,
    GLINT_IRRADIANCE_BY_MAP,
    GLINT_IRRADIANCE_BY_HARMONICS,
    GLINT_IRRADIANCE_KINDS,
} glint_irradiance_kind;

// What a plan's kernels read. The buffers are borrowed.
typedef struct glint_chosen_light {
    cl_mem environment, irradiance, lobes;
    int environment_edge;
    int irradiance_edge; // 0: no map
} glint_chosen_light;

// Zero is valid: no environment.
typedef struct glint_light {
    const struct glint_device *device;    // borrowed
    const glint_environment *environment; // likewise
    glint_proxy proxy;                    // the environment's
    glint_half_rounding half;             // what it loses as halfs, once that was asked for
    bool half_is_known;
    glint_shared_buffer texels[2];              // as floats, as halfs
    cl_mem irradiances[GLINT_IRRADIANCE_KINDS]; // see kernels/layout.h
    glint_shared_buffer lobes; // what rough surfaces read: albedos and cells; zero: none yet
    int cells_last;            // their finest level
    bool knows_sheen;          // they have the albedo of sheen
    glint_chosen_light chosen; // for the plan at hand
    double upload_ms;          // of all that was made of this environment
    double irradiance_ms;      // likewise, and of those before
    double cells_ms;           // likewise
} glint_light;

// Another environment in the place of the one that there was; nothing is uploaded yet. It is
// borrowed as long as plans are chosen for.
void glint_light_set_environment(glint_light *light, const glint_environment *environment);

// Whether settings may choose half texels.
bool glint_light_may_be_half(const glint_settings *settings);

// Measures the rounding where the settings may choose halfs. Errors: as
// glint_half_rounding_measure.
glint_status glint_light_measure_half(glint_light *light, const glint_settings *settings,
                                      glint_error *error);

// Finds or makes what the plan reads. `without_frames`: no irradiance map is read. Errors:
// GLINT_DEVICE_FAILED, GLINT_OUT_OF_MEMORY.
glint_status glint_light_choose(glint_light *light, const glint_plan *plan, bool without_frames,
                                glint_error *error);

// Bytes of all that there is.
size_t glint_light_bytes(const glint_light *light);

void glint_light_free(glint_light *light);

#endif
