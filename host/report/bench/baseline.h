// Compares a run of the benchmark with an earlier run, both as JSON (bench_json.h).
#ifndef GLINT_REPORT_BENCH_BASELINE_H
#define GLINT_REPORT_BENCH_BASELINE_H

#include "base/status.h"
#include "report/json.h"

typedef enum glint_verdict {
    GLINT_VERDICT_SAME,
    GLINT_VERDICT_FASTER,
    GLINT_VERDICT_SLOWER,
    GLINT_VERDICT_MISSING, // the baseline has no scene of this name
} glint_verdict;

// The result for one scene.
typedef struct glint_comparison {
    glint_verdict verdict;
    double before, now; // median kernel times of a frame, milliseconds
} glint_comparison;

// Reads the file and checks its form. `*baseline` is a new reference. Errors: GLINT_BAD_INPUT.
glint_status glint_baseline_load(const char *path, json_t **baseline, glint_error *error);

// The earlier run. All members are borrowed.
typedef struct glint_baseline {
    const json_t *document; // from glint_baseline_load
    const char *path;       // for messages
    double margin;          // 0.1 is 10%
} glint_baseline;

// Compares `scene`, a measured entry of this run, with the baseline's entry of the same name.
//
// Slower means two things: the median is more than the margin above the earlier median, and the
// middle halves (quartiles) of both series do not overlap. So a difference smaller than the noise
// of either run does not count. Faster is the reverse.
//
// Refuses an entry of another device, of other settings, or of another scene, environment or camera
// under the same name. The error is then GLINT_BAD_INPUT and names the difference.
glint_status glint_baseline_compare(const glint_baseline *baseline, const json_t *scene,
                                    glint_comparison *comparison, glint_error *error);

// The comparison as JSON: "verdict", "milliseconds_before", "milliseconds_now" and "change" (0.1:
// this run takes 10% longer). The numbers are null if the scene is missing.
json_t *glint_comparison_json(const char *name, const glint_comparison *comparison);

#endif
