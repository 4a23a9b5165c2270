// Opens and writes the outputs of --json FILE|- and --stats FILE|-.
#ifndef GLINT_CLI_COMMON_JSON_OUTPUT_H
#define GLINT_CLI_COMMON_JSON_OUTPUT_H

#include "base/status.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

// True if `path` is "-": standard output, which then carries no other text. `path` may be NULL.
bool glint_is_stdout(const char *path);

// Prints the report to standard output, or writes the whole file or nothing. Takes over the
// reference to `root`. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_write_json(const char *path, json_t *root, glint_error *error);

// Opens a file for lines and empties it; "-" is standard output. The caller closes it with fclose.
// Errors: GLINT_OUTPUT_FAILED.
glint_status glint_open_lines(const char *path, FILE **file, glint_error *error);

#endif
