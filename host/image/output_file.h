// Writes a file that appears whole or not at all.
#ifndef GLINT_IMAGE_OUTPUT_FILE_H
#define GLINT_IMAGE_OUTPUT_FILE_H

#include "base/status.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Checks whether glint could write `path`. Fails with GLINT_OUTPUT_FAILED if the folder is missing
// or not writable, or if something stands there that must not be replaced. Creates nothing.
glint_status glint_output_file_check(const char *path, glint_error *error);

// Checks the folder alone, whatever stands at `path`.
glint_status glint_output_file_check_folder(const char *path, glint_error *error);

// Writes `size` bytes under a temporary name in the folder of `path`, syncs them to the disk and
// renames the file. Replaces a file at `path`; follows a symbolic link, which stays. The file's
// permissions are 0666 less the umask. Before its first file in a folder, a process removes
// temporaries that dead processes of this machine left there. On failure no file is left behind.
glint_status glint_output_file_write(const char *path, const void *bytes, size_t size,
                                     glint_error *error);

// The number of files that may be written at once with their temporaries known to
// glint_output_file_discard_all.
#define GLINT_OUTPUT_FILES_AT_ONCE 120

// Unlinks every temporary in flight and prevents new ones. Async-signal-safe: for a signal handler
// that then calls _exit.
void glint_output_file_discard_all(void);

#ifdef __cplusplus
}
#endif

#endif
