// Compares file names from the command line and reads their extensions.
#ifndef GLINT_CLI_COMMON_FILE_NAMES_H
#define GLINT_CLI_COMMON_FILE_NAMES_H

#include <stdbool.h>

// True if both names lead to the same file, whether it exists or not. NULL matches nothing.
bool glint_same_file(const char *a, const char *b);

// True if the name ends in `extension` (".exr"). The case of letters does not matter.
bool glint_has_extension(const char *path, const char *extension);

#endif
