// Reports the progress of a frame.
#ifndef GLINT_RENDER_PROGRESS_H
#define GLINT_RENDER_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

// Called between launches with the number of bands of tiles that are done, and of all bands. If it
// returns false, the frame stops with GLINT_INTERRUPTED.
typedef struct glint_progress {
    bool (*step)(void *context, uint64_t done, uint64_t total);
    void *context;
} glint_progress;

#endif
