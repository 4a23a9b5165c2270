// Prints the results of glint bench --error for people. Reads the same JSON as --json writes.
#ifndef GLINT_CLI_BENCH_ERROR_TABLE_H
#define GLINT_CLI_BENCH_ERROR_TABLE_H

#include "report/json.h"

#include <stdio.h>

// Prints one scene of a document (report/speed_error/speed_error_json.h).
void glint_error_print_scene(const json_t *scene, FILE *out);

#endif
