// Six files that are the faces of a cube: found by their names.
#ifndef GLINT_ENVIRONMENT_FACE_FILES_H
#define GLINT_ENVIRONMENT_FACE_FILES_H

#include "base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// Paths in the order posx negx posy negy posz negz, owned; zero is valid.
typedef struct glint_face_files {
    char *paths[6];
} glint_face_files;

void glint_face_files_free(glint_face_files *files);

// The faces that a pattern names: its %s stands for posx, negx …; px, nx …; right, left, top,
// bottom, front, back (front is posz); right, left, up, down, front, back; or +x, −x …; each in
// small letters, in capitals or capitalised. GLINT_BAD_INPUT where no set is complete (the missing
// file is named) or more than one is.
glint_status glint_face_files_by_pattern(const char *pattern, glint_face_files *files,
                                         glint_error *error);

// The faces in a folder: files named as above, alone or after a common beginning, and with a common
// extension: posx.png, xmas_posx.png, Sky-Right.hdr, env+x.exr.
glint_status glint_face_files_in_folder(const char *folder, glint_face_files *files,
                                        glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
