// Compiles the special kernels of a long sequence in another process, while general kernels render
// its first frames.
#ifndef GLINT_CLI_RENDER_KERNELS_AHEAD_H
#define GLINT_CLI_RENDER_KERNELS_AHEAD_H

#include "render/frame.h"

#include <stdbool.h>
#include <sys/types.h>

// Zero: nothing has been started.
typedef struct render_kernels_ahead {
    pid_t process; // glint warm, until it is reaped; 0: none
    bool was_started;
} render_kernels_ahead;

// Starts to compile if the renderer would gain by it and the rest of the sequence takes `left_ms`,
// which is long enough. `device` is the renderer's. A start that fails changes nothing.
void render_kernels_ahead_consider(render_kernels_ahead *ahead, const glint_renderer *renderer,
                                   const glint_capabilities *device, double left_ms);

// Stops compiling.
void render_kernels_ahead_end(render_kernels_ahead *ahead);

#endif
