// Where a command's --json FILE|- goes.
#ifndef GLINT_CLI_COMMON_JSON_OUTPUT_H
#define GLINT_CLI_COMMON_JSON_OUTPUT_H

#include "base/status.h"

#include <jansson.h>
#include <stdbool.h>

// True for "-": standard output, which then holds nothing else. NULL is no path.
bool glint_is_stdout(const char *path);

// Prints the report, or writes the file whole or not at all. Takes the reference. Errors:
// GLINT_OUTPUT_FAILED.
glint_status glint_write_json(const char *path, json_t *root, glint_error *error);

#endif
