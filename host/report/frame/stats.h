// Writes the --stats file: times and counts of rendered frames.
#ifndef GLINT_REPORT_FRAME_STATS_H
#define GLINT_REPORT_FRAME_STATS_H

#include "base/status.h"
#include "bound/error_bound.h"
#include "image/tone.h"
#include "render/frame.h"
#include "report/frame/subject.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

// The statistics of a run or a frame. All borrowed. Milliseconds are wall-clock.
typedef struct glint_stats {
    const glint_subject *subject;
    const char *output; // file name of the image
    const glint_phases *phases;
    const glint_frame_report *frame;
    uint64_t frames; // number of frames of a sequence
    double load_scene_ms, load_environment_ms, encode_ms, total_ms;
    double exposure;                  // stops
    glint_tone tone;                  // tone mapping of the written image
    const char *plate;                // background file as given; NULL: none
    const glint_error_choice *choice; // only with --max-error, else NULL
} glint_stats;

// The statistics of one frame as JSON: a new reference; NULL without memory.
json_t *glint_stats_json(const glint_stats *stats);

// ---- Of a sequence -----------------------------------------------------------------------------

// A finished frame.
typedef struct glint_stats_frame {
    int number;
    const char *file;
    const char *outcome;              // "rendered", "skipped" or "failed"
    const char *error;                // reason of a failure, else NULL
    const glint_frame_report *report; // NULL for a skipped frame
    const char *tree;                 // "kept", "fitted" or "built"; NULL: not known
    const glint_error_choice *choice; // only with --max-error, else NULL
    double build_ms, trace_ms, write_ms;
} glint_stats_frame;

// The totals of a run.
typedef struct glint_stats_total {
    uint64_t frames; // frames of this run
    uint64_t rendered, skipped, failed;
    glint_ray_counts rays;
    double build_ms, trace_ms, write_ms; // sums; frames are traced while others are written
    double total_ms;
    bool stopped; // before all frames were finished
} glint_stats_total;

// A file of lines that grows with each finished frame. Each line is a complete JSON object, even if
// the run is killed later. Opaque.
typedef struct glint_stats_log glint_stats_log;

// Begins the log with a line about the run; does not use run->frame or run->encode_ms. Takes over
// `file`. Messages name it `path`. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_stats_log_open(FILE *file, const char *path, const glint_stats *run,
                                  glint_stats_log **log, glint_error *error);
glint_status glint_stats_log_frame(glint_stats_log *log, const glint_stats_frame *frame,
                                   glint_error *error);
// Writes the last line.
glint_status glint_stats_log_total(glint_stats_log *log, const glint_stats_total *total,
                                   glint_error *error);
void glint_stats_log_close(glint_stats_log *log); // accepts NULL

#endif
