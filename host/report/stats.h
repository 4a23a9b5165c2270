// What a rendered frame took and counted, as a file for --stats.
#ifndef GLINT_REPORT_STATS_H
#define GLINT_REPORT_STATS_H

#include "base/status.h"
#include "render/frame.h"
#include "report/subject.h"

// All borrowed. Milliseconds are wall-clock.
typedef struct glint_stats {
    const glint_subject *subject;
    const char *output; // the image's file name
    const glint_phases *phases;
    const glint_frame_report *frame;
    double load_scene_ms, load_environment_ms, encode_ms, total_ms;
    double exposure; // stops
} glint_stats;

// All rays that were traced or looked up.
uint64_t glint_stats_rays(const glint_ray_counts *rays);

// The share of all weight that was truncated, for whatever reason.
double glint_stats_truncated(const glint_truncation *truncation);

// Writes the file, whole or not at all. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_stats_write(const char *path, const glint_stats *stats, glint_error *error);

#endif
