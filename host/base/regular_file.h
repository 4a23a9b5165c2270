// Opens files for reading and never blocks: it refuses pipes and devices.
#ifndef GLINT_BASE_REGULAR_FILE_H
#define GLINT_BASE_REGULAR_FILE_H

#include "base/status.h"

#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

// The caller closes *file. *size is set to the file's bytes; `size` may be NULL. Errors:
// GLINT_BAD_INPUT if the file does not exist, is a folder, a pipe or a device, or is not readable.
glint_status glint_regular_file_open(const char *path, FILE **file, uint64_t *size,
                                     glint_error *error);

// Does the same with a descriptor. Errors: GLINT_BAD_INPUT with the reason, without the path; *file
// is then −1.
glint_status glint_regular_file_descriptor(const char *path, int *file, uint64_t *size,
                                           glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
