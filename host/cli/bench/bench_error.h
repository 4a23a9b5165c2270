// glint bench --error: every rung of a scene's ladder, and the page that shows them.
#ifndef GLINT_CLI_BENCH_BENCH_ERROR_H
#define GLINT_CLI_BENCH_BENCH_ERROR_H

#include "cli/common/inputs.h"
#include "report/json.h"
#include "report/speed_error/speed_error.h"

// Refuses settings that the ladder has for itself.
// Errors: GLINT_USAGE.
glint_status bench_error_check(const glint_settings *settings, glint_error *error);

// What bench_error_measure works on; all borrowed.
typedef struct bench_error_task {
    const glint_input_request *request;
    const glint_inputs *loaded;
    const glint_speed_error_options *options;
    const glint_bench_watcher *watcher;
} bench_error_task;

// Measures what was loaded; `text` is the scene's entry of the report
// (report/speed_error/speed_error_json.h), malloc'd. Errors: as glint_speed_error_measure and
// glint_speed_error_scene_json.
glint_status bench_error_measure(const bench_error_task *task, char **text, glint_error *error);

// Writes the page and the JSON where they are wanted; NULL: not wanted. Errors:
// GLINT_OUTPUT_FAILED.
glint_status bench_error_write(json_t *document, const char *html, const char *json,
                               glint_error *error);

#endif
