// Folders that commands make for the files that they write.
#ifndef GLINT_CLI_COMMON_OUTPUT_FOLDER_H
#define GLINT_CLI_COMMON_OUTPUT_FOLDER_H

#include "base/status.h"

#include <stdbool.h>

// The folder of a file, malloc'd: "." where its path names none. NULL without memory.
char *glint_folder_of(const char *path);

bool glint_is_folder(const char *path);

// Whether a folder could be made there: where a file could be put. Nothing is made. Errors:
// GLINT_OUTPUT_FAILED.
glint_status glint_folder_check(const char *folder, glint_error *error);

// Makes the folder, unless it is there; its own folder must be. *is_new (may be NULL): it was made.
// Errors: GLINT_OUTPUT_FAILED.
glint_status glint_folder_make(const char *folder, bool *is_new, glint_error *error);

#endif
