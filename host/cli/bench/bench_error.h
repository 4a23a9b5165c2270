// Measures every rung of a scene's ladder for glint bench --error.
#ifndef GLINT_CLI_BENCH_BENCH_ERROR_H
#define GLINT_CLI_BENCH_BENCH_ERROR_H

#include "cli/common/inputs.h"
#include "report/json.h"
#include "report/speed_error/speed_error.h"

// Refuses settings that the ladder varies itself. Errors: GLINT_USAGE.
glint_status bench_error_check(const glint_settings *settings, glint_error *error);

// The inputs of bench_error_measure; all borrowed.
typedef struct bench_error_task {
    const glint_input_request *request;
    const glint_inputs *loaded;
    const glint_speed_error_options *options;
    const glint_bench_watcher *watcher;
} bench_error_task;

// Measures the loaded scene. `text` becomes the scene's entry in the report
// (report/speed_error/speed_error_json.h), malloc'd. Errors: as glint_speed_error_measure and
// glint_speed_error_scene_json.
glint_status bench_error_measure(const bench_error_task *task, char **text, glint_error *error);

#endif
