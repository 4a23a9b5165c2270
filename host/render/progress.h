// How far a frame is, for whoever waits.
#ifndef GLINT_RENDER_PROGRESS_H
#define GLINT_RENDER_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

// Called between launches with how many bands of tiles, of all there are, have been rendered.
// Returning false stops the frame with GLINT_INTERRUPTED.
typedef struct glint_progress {
    bool (*step)(void *context, uint64_t done, uint64_t total);
    void *context;
} glint_progress;

#endif
