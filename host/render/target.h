// Holds the buffers that a frame is written to: pixels, counters, layers and terms. Used in this
// folder only.
#ifndef GLINT_RENDER_TARGET_H
#define GLINT_RENDER_TARGET_H

#include "base/status.h"
#include "device/buffer.h"
#include "render/arguments.h"
#include "render/layers.h"
#include "render/owners.h"
#include "render/pixels.h"
#include "render/plan.h"

#include <stddef.h>
#include <stdint.h>

typedef enum glint_target_part {
    GLINT_TARGET_PIXELS,
    GLINT_TARGET_COUNTERS,
    GLINT_TARGET_LAYERS,
    GLINT_TARGET_TERMS,
    GLINT_TARGET_LIST, // input: the pixels to render
    GLINT_TARGET_PARTS
} glint_target_part;

// Zero is valid. Buffers never shrink, so that small and large frames can alternate (see
// bound/error_grid.h).
typedef struct glint_target {
    const struct glint_device *device; // borrowed
    cl_mem buffers[GLINT_TARGET_PARTS];
    glint_pixels pixels;
} glint_target;

// Computes the sizes of the buffers for frames of these settings and this precision. Errors:
// GLINT_USAGE if a size overflows.
glint_status glint_target_measure(const glint_settings *settings, size_t scalar_bytes,
                                  glint_content contents[GLINT_TARGET_PARTS], glint_error *error);

// Bytes of a frame's pixels, layers and terms.
size_t glint_target_frame_bytes(const glint_settings *settings, size_t scalar_bytes);

// Makes the buffers large enough for these contents, and uploads the list. Errors:
// GLINT_DEVICE_FAILED.
glint_status glint_target_fit(glint_target *target, const glint_settings *settings,
                              size_t scalar_bytes, const glint_content contents[GLINT_TARGET_PARTS],
                              glint_error *error);

// The arguments of the kernels. If the device writes into an image, the caller sets `pixels`.
glint_output_arguments glint_target_arguments(const glint_target *target);

// Clear and read the counters of the last frame: 32-bit words, see kernels/layout.h.
#define GLINT_COUNTER_WORDS (GLINT_COUNTER_SLOTS * GLINT_COUNTERS * 2)
glint_status glint_target_clear_counters(const glint_target *target, glint_error *error);
glint_status glint_target_read_counters(const glint_target *target,
                                        uint32_t words[GLINT_COUNTER_WORDS], glint_error *error);

// Reads the layers and terms of the last frame, which was rendered with these settings. On failure
// *layers is empty.
glint_status glint_target_layers(const glint_target *target, const glint_settings *settings,
                                 const glint_owners *owners, glint_layers *layers,
                                 glint_error *error);

void glint_target_free(glint_target *target);

#endif
