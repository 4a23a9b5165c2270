// Comparing a run of the benchmark with an earlier one, both as JSON (bench_json.h).
#ifndef GLINT_REPORT_BENCH_BASELINE_H
#define GLINT_REPORT_BENCH_BASELINE_H

#include "base/status.h"
#include "report/json.h"

typedef enum glint_verdict {
    GLINT_VERDICT_SAME,
    GLINT_VERDICT_FASTER,
    GLINT_VERDICT_SLOWER,
    GLINT_VERDICT_MISSING, // the baseline has no scene of that name
} glint_verdict;

typedef struct glint_comparison {
    glint_verdict verdict;
    double before, now; // medians of the launches of a frame, milliseconds
} glint_comparison;

// Reads the file and checks its form. `*baseline` is a new reference. Errors: GLINT_BAD_INPUT.
glint_status glint_baseline_load(const char *path, json_t **baseline, glint_error *error);

// What a run is compared with. Borrowed.
typedef struct glint_baseline {
    const json_t *document; // as loaded
    const char *path;       // for messages
    double margin;          // 0.1 is 10%
} glint_baseline;

// Compares `scene`, an entry of this run that was measured, with the entry of that name. Slower
// is a median more than the margin above the earlier one, with the middle halves of both rows of
// times apart: a shift that the noise of either could explain is none. Faster is the same the
// other way round. Refuses, with GLINT_BAD_INPUT and what differs, an entry of another device,
// of other settings, or of another scene, environment or camera under the same name.
glint_status glint_baseline_compare(const glint_baseline *baseline, const json_t *scene,
                                    glint_comparison *comparison, glint_error *error);

// The comparison as JSON: "verdict", "milliseconds_before", "milliseconds_now", "change" (0.1: this
// run takes 10% longer); the numbers are null where the scene is missing.
json_t *glint_comparison_json(const char *name, const glint_comparison *comparison);

#endif
