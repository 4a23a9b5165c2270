// Launches the kernels over the tiles of a frame. Used in this folder only.
#ifndef GLINT_RENDER_LAUNCHES_H
#define GLINT_RENDER_LAUNCHES_H

#include "base/status.h"
#include "kernels/layout.h"
#include "render/arguments.h"
#include "render/kernels.h"
#include "render/plan.h"
#include "render/progress.h"

// The kernels to launch, with their plan and arguments. Pointers are borrowed.
typedef struct glint_launcher {
    const struct glint_device *device;
    const glint_plan *plan;
    const glint_kernels *kernels; // kernels of the plan
    glint_scene_arguments scene;
    glint_output_arguments outputs;
} glint_launcher;

// Renders all tiles in launches of about a tenth of a second. Asks `progress`, which may be NULL,
// between launches. *bands_per_ms is the speed of the last frame (0 before the first); the function
// updates it. Errors: GLINT_DEVICE_FAILED, GLINT_INTERRUPTED.
glint_status glint_launches_run(const glint_launcher *launcher, glint_frame_record *record,
                                const glint_progress *progress, double *bands_per_ms,
                                glint_error *error);

// Launches the kernel once over a frame without pixels, because drivers delay a part of the
// compilation until the first launch. It writes no pixel, so a device that writes into images needs
// no image yet. Errors: GLINT_DEVICE_FAILED.
glint_status glint_launches_warm_up(const glint_launcher *launcher, glint_error *error);

// Waits for the end of a launch and releases `done`. Errors: GLINT_DEVICE_FAILED.
glint_status glint_launch_wait(const struct glint_device *device, cl_event done,
                               glint_error *error);

#endif
