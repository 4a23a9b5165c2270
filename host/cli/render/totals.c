// Adds up the figures of frames. See totals.h.
#include "cli/render/totals.h"

#include <math.h>
#include <stdlib.h>

static void add_to_spread(render_spread *spread, uint64_t before, double value)
{
    spread->sum += value;
    spread->least = before == 0 ? value : fmin(spread->least, value);
    spread->most = before == 0 ? value : fmax(spread->most, value);
}

static void keep_worst(glint_frame_report *worst, const glint_frame_report *report)
{
    const uint64_t overflows = worst->truncation.media_overflows;
    if (glint_truncation_total(&report->truncation) > glint_truncation_total(&worst->truncation)) {
        worst->truncation = report->truncation;
        worst->truncation.media_overflows = overflows;
    }
    if (report->truncation.media_overflows > overflows) {
        worst->truncation.media_overflows = report->truncation.media_overflows;
    }
    if (report->nonfinite_pixels > worst->nonfinite_pixels) {
        worst->nonfinite_pixels = report->nonfinite_pixels;
    }
}

void render_totals_add(render_totals *totals, const render_rendered *frame)
{
    const uint64_t before = totals->rendered++;
    if (frame->choice != NULL) {
        add_to_spread(&totals->error, before, frame->choice->error);
        add_to_spread(&totals->choosing, before, frame->choice->choosing_ms);
    }
    add_to_spread(&totals->build, before, frame->build_ms);
    add_to_spread(&totals->trace, before, frame->trace_ms);
    add_to_spread(&totals->write, before, frame->write_ms);
    glint_ray_counts_add(&totals->rays, &frame->report->rays);
    keep_worst(&totals->worst, frame->report);
}

void render_totals_add_failed(render_totals *totals, int frame)
{
    if (totals->failed_known == totals->failed_capacity) {
        const size_t capacity = 2 * totals->failed_capacity + 16;
        int *frames = realloc(totals->failed_frames, capacity * sizeof *frames);
        if (frames != NULL) {
            totals->failed_frames = frames;
            totals->failed_capacity = capacity;
        }
    }
    totals->failed++;
    if (totals->failed_known < totals->failed_capacity) {
        totals->failed_frames[totals->failed_known++] = frame;
    }
}

void render_totals_free(render_totals *totals)
{
    free(totals->failed_frames);
    *totals = (render_totals){0};
}
