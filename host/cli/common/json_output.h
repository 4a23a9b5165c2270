// Where a command's --json FILE|- and --stats FILE|- go.
#ifndef GLINT_CLI_COMMON_JSON_OUTPUT_H
#define GLINT_CLI_COMMON_JSON_OUTPUT_H

#include "base/status.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

// True for "-": standard output, which then holds nothing else. NULL is no path.
bool glint_is_stdout(const char *path);

// Prints the report, or writes the file whole or not at all. Takes the reference. Errors:
// GLINT_OUTPUT_FAILED.
glint_status glint_write_json(const char *path, json_t *root, glint_error *error);

// A file to write lines to, which replaces what stood there; "-" is standard output. For fclose.
// Errors: GLINT_OUTPUT_FAILED.
glint_status glint_open_lines(const char *path, FILE **file, glint_error *error);

#endif
