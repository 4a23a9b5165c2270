// Finds the files that a glTF file refers to by URIs.
#ifndef GLINT_SCENE_GLTF_FIND_FILE_H
#define GLINT_SCENE_GLTF_FIND_FILE_H

#include "base/status.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// Decodes percent signs (RFC 3986); one without two hexadecimal digits stays. `decoded` has room
// for `length` bytes, and may be `text`. Returns its length.
size_t glint_percent_decode(const char *text, size_t length, char *decoded);

// Returns the folder of a file, with links resolved, malloc'd. Errors: GLINT_BAD_INPUT without the
// file's name; GLINT_OUT_OF_MEMORY.
glint_status glint_find_folder(const char *file, char **folder, glint_error *error);

// Finds the regular file that a relative reference names; a pipe or a device would hang. Finds none
// for schemes such as http, and none outside of the folder, which has its links resolved. Tries the
// name also as it stands, and with backslashes as slashes. *path is malloc'd. Errors:
// GLINT_BAD_INPUT with the reason, without the URI; GLINT_OUT_OF_MEMORY.
glint_status glint_find_file(const char *folder, const char *uri, char **path, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
