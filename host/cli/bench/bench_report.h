// Holds the report of glint bench while scenes are measured: prints it, compares it with a baseline
// and writes it.
#ifndef GLINT_CLI_BENCH_BENCH_REPORT_H
#define GLINT_CLI_BENCH_BENCH_REPORT_H

#include "base/status.h"
#include "report/json.h"

#include <stdbool.h>
#include <stddef.h>

#define BENCH_DEFAULT_MARGIN 10.0 // percent

// The report. The caller sets the members up to `names`; they are borrowed, and paths may be NULL.
// Zero is valid.
typedef struct bench_report {
    const char *json; // "-" is stdout, in place of the table
    const char *html; // of --error
    const char *baseline_path;
    double margin; // percent
    bool error;    // the report of --error
    const char *const *names;
    size_t count; // of scenes to measure
    json_t *document;
    json_t *baseline;               // NULL: none
    json_t *comparisons;            // a list, one entry per scene with a correct picture
    size_t wrong, compared, slower; // numbers of scenes
    size_t written;                 // scenes in the JSON file
} bench_report;

// Reads the baseline, and takes over `document`, whose list of scenes is empty. Errors:
// GLINT_BAD_INPUT.
glint_status bench_report_begin(bench_report *report, json_t *document, glint_error *error);

// Prints a scene's entry, and adds it if it can be compared with the baseline. Takes over the
// reference. Writes the JSON to its file, marked as incomplete unless this is the last scene, so
// that a run that is cut off leaves what was measured. Errors: as glint_baseline_compare,
// GLINT_OUTPUT_FAILED.
glint_status bench_report_add(bench_report *report, json_t *entry, glint_error *error);

// Writes the page, prints the JSON if it goes to stdout, and judges the finished report. Errors:
// GLINT_OUTPUT_FAILED, GLINT_MISMATCH, GLINT_BAD_INPUT.
glint_status bench_report_finish(bench_report *report, glint_error *error);

// Says which scenes the report of a run holds that ended early. Prints it if it goes to stdout.
void bench_report_leave(bench_report *report);

void bench_report_free(bench_report *report);

#endif
