// Bytes to a file that appears whole or not at all.
#ifndef GLINT_IMAGE_OUTPUT_FILE_H
#define GLINT_IMAGE_OUTPUT_FILE_H

#include "base/status.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Whether a file could be put at `path`: GLINT_OUTPUT_FAILED where the folder is missing or not
// writable, or where something stands that must not be replaced. Nothing is created.
glint_status glint_output_file_check(const char *path, glint_error *error);

// The same of the folder alone, whatever stands at `path`.
glint_status glint_output_file_check_folder(const char *path, glint_error *error);

// Writes `size` bytes under a temporary name in the folder of `path`, brings them to the disk and
// renames. What stood at `path` is replaced; a symbolic link is followed and stays. The file's
// permissions are 0666 less the umask. Temporaries that dead processes of this machine left in the
// folder are removed before the first file that this process writes there. On failure nothing is
// left behind.
glint_status glint_output_file_write(const char *path, const void *bytes, size_t size,
                                     glint_error *error);

// So many files may be written at once with their temporaries known to
// glint_output_file_discard_all.
#define GLINT_OUTPUT_FILES_AT_ONCE 120

// Unlinks every temporary in flight and lets no further one be made. Async-signal-safe: for a
// signal handler on its way to _exit.
void glint_output_file_discard_all(void);

#ifdef __cplusplus
}
#endif

#endif
