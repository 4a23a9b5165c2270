// Adds up the figures of a run's frames.
#ifndef GLINT_CLI_RENDER_TOTALS_H
#define GLINT_CLI_RENDER_TOTALS_H

#include "bound/error_bound.h"
#include "render/frame.h"

// Sum and range of a figure over several frames.
typedef struct render_spread {
    double sum, least, most;
} render_spread;

// The totals of a run. Zero is valid: no frame is finished.
typedef struct render_totals {
    uint64_t rendered, skipped;
    size_t failed;
    size_t failed_known, failed_capacity;
    // in the order of failure; incomplete (failed_known < failed) if memory ran short. Owned
    int *failed_frames;
    glint_ray_counts rays;
    render_spread error;    // relative RMSE, only with --max-error
    render_spread choosing; // milliseconds, only with --max-error
    // milliseconds. build: scene and tree of the frame, partly while the frame before is traced
    render_spread build, trace, write;
    // the highest truncated weight, and the highest of each other figure that causes warnings
    glint_frame_report worst;
} render_totals;

// The figures of one rendered frame. Times are milliseconds; `choice` is NULL without --max-error.
typedef struct render_rendered {
    const glint_frame_report *report;
    const glint_error_choice *choice;
    double build_ms, trace_ms, write_ms;
} render_rendered;

void render_totals_add(render_totals *totals, const render_rendered *frame);

void render_totals_add_failed(render_totals *totals, int frame);

void render_totals_free(render_totals *totals);

#endif
