// What came of a run's frames, added up.
#ifndef GLINT_CLI_RENDER_TOTALS_H
#define GLINT_CLI_RENDER_TOTALS_H

#include "bound/error_bound.h"
#include "render/frame.h"

// Of several frames.
typedef struct render_spread {
    double sum, least, most;
} render_spread;

// Zero is valid: no frame is through.
typedef struct render_totals {
    uint64_t rendered, skipped;
    size_t failed;
    size_t failed_known, failed_capacity;
    int *failed_frames; // owned; in the order in which they failed, as many as found memory
    glint_ray_counts rays;
    render_spread error;               // relative RMSE, where --max-error asks for it
    render_spread choosing;            // milliseconds, likewise
    render_spread build, trace, write; // milliseconds; build: the scene at its time, its tree;
                                       // beside the frame before
    glint_frame_report worst; // the one with the most truncated weight, with the largest of the
                              // other figures that warnings are about
} render_totals;

// A frame that was rendered. Milliseconds; `choice` is NULL without --max-error.
typedef struct render_rendered {
    const glint_frame_report *report;
    const glint_error_choice *choice;
    double build_ms, trace_ms, write_ms;
} render_rendered;

void render_totals_add(render_totals *totals, const render_rendered *frame);

void render_totals_add_failed(render_totals *totals, int frame);

void render_totals_free(render_totals *totals);

#endif
