// What a rendered frame took and counted, as a file for --stats.
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

// All borrowed. Milliseconds are wall-clock.
typedef struct glint_stats {
    const glint_subject *subject;
    const char *output; // the image's file name
    const glint_phases *phases;
    const glint_frame_report *frame;
    uint64_t frames; // of a sequence
    double load_scene_ms, load_environment_ms, encode_ms, total_ms;
    double exposure;                  // stops
    glint_tone tone;                  // of what is written
    const char *plate;                // the background's file as it was given, NULL without one
    const glint_error_choice *choice; // where an error was to be kept, else NULL
} glint_stats;

// A new reference; NULL without memory.
json_t *glint_stats_json(const glint_stats *stats);

// ---- Of a sequence -----------------------------------------------------------------------------

// A frame that is through.
typedef struct glint_stats_frame {
    int number;
    const char *file;
    const char *outcome;              // "rendered", "skipped" or "failed"
    const char *error;                // what went wrong; NULL
    const glint_frame_report *report; // NULL of a skipped one
    const char *tree;                 // "kept", "fitted" or "built"; NULL where that is not known
    const glint_error_choice *choice; // as above
    double build_ms, trace_ms, write_ms;
} glint_stats_frame;

typedef struct glint_stats_total {
    uint64_t frames; // that there were to do
    uint64_t rendered, skipped, failed;
    glint_ray_counts rays;
    double build_ms, trace_ms, write_ms; // sums; frames are traced while others are written
    double total_ms;
    bool stopped; // before all were through
} glint_stats_total;

// A file of lines that grows as frames come through: an object each, complete whatever happens to
// the run. Opaque.
typedef struct glint_stats_log glint_stats_log;

// Begins with a line of the run; of `run`, frame and encode_ms are not used. Takes the file, whose
// name `path` messages give. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_stats_log_open(FILE *file, const char *path, const glint_stats *run,
                                  glint_stats_log **log, glint_error *error);
glint_status glint_stats_log_frame(glint_stats_log *log, const glint_stats_frame *frame,
                                   glint_error *error);
// The last line.
glint_status glint_stats_log_total(glint_stats_log *log, const glint_stats_total *total,
                                   glint_error *error);
void glint_stats_log_close(glint_stats_log *log); // NULL is allowed

#endif
