// What the command line's file names tell of themselves.
#ifndef GLINT_CLI_COMMON_FILE_NAMES_H
#define GLINT_CLI_COMMON_FILE_NAMES_H

#include <stdbool.h>

// True if both names lead to one file, whether it exists or not. NULL is no file.
bool glint_same_file(const char *a, const char *b);

// True if the name ends in `extension` (".exr"), in any case.
bool glint_has_extension(const char *path, const char *extension);

#endif
