// Opening files for reading without waiting: pipes and devices are refused.
#ifndef GLINT_BASE_REGULAR_FILE_H
#define GLINT_BASE_REGULAR_FILE_H

#include "base/status.h"

#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

// The caller closes *file. `size` gets the file's bytes; NULL: not wanted. Errors: GLINT_BAD_INPUT
// where there is no such file, or it is a folder, a pipe or a device, or may not be read.
glint_status glint_regular_file_open(const char *path, FILE **file, uint64_t *size,
                                     glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
