// Checks and creates folders for output files.
#ifndef GLINT_CLI_COMMON_OUTPUT_FOLDER_H
#define GLINT_CLI_COMMON_OUTPUT_FOLDER_H

#include "base/status.h"

#include <stdbool.h>

// The folder of a file, malloc'd: "." for a bare file name. NULL without memory.
char *glint_folder_of(const char *path);

bool glint_is_folder(const char *path);

// Checks that `folder` exists or could be created. Creates nothing. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_folder_check(const char *folder, glint_error *error);

// Creates the folder if it is missing; its parent must exist. *is_new (may be NULL) tells whether
// the call created it. Errors: GLINT_OUTPUT_FAILED.
glint_status glint_folder_make(const char *folder, bool *is_new, glint_error *error);

#endif
