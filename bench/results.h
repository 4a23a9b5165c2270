// Writes the shared parts of the contests' reports.
#ifndef GLINT_BENCH_RESULTS_H
#define GLINT_BENCH_RESULTS_H

#include "agreement.h"
#include "series.h"
#include "stage.h"

#include <jansson.h>

// Returns the report without its scenes: machine, versions of glint and of the program `other`,
// device, size and rounds. The caller owns returned objects, if nothing else is said.
json_t *bench_report_start(const bench_stage *stage, const char *other, const char *version);

// Prints the head of the table; `other` names the column of the other program's times.
void bench_report_head(const char *other);

// A line of the table. All pointers are borrowed.
typedef struct bench_line {
    const char *scene, *job;
    double glint_ms, other_ms; // medians
    bench_summary ratio;
    const char *against;              // variant of the other program
    const bench_agreement *agreement; // NULL: nothing was compared
} bench_line;

void bench_report_line(const bench_line *line);

// Adds an object for a scene to the report. Returns it, borrowed.
json_t *bench_report_add_scene(json_t *report, const bench_scene *scene);

json_t *bench_report_summary(bench_summary summary);
json_t *bench_report_agreement(const bench_agreement *agreement);

#endif
