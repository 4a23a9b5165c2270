// Finds the six files that are the faces of a cube, by their names.
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

// Finds the faces that a pattern names. Its %s stands for posx, negx …; px, nx …; right, left, top,
// bottom, front, back (front is posz); right, left, up, down, front, back; or +x, −x …. Names may
// be in small letters, in capitals or capitalised. Fails with GLINT_BAD_INPUT if no set is complete
// (the message names the missing file) or if several sets are complete.
glint_status glint_face_files_by_pattern(const char *pattern, glint_face_files *files,
                                         glint_error *error);

// Finds the faces in a folder. The file names end with a face's name as above. They may have a
// common beginning and have a common extension: posx.png, xmas_posx.png, Sky-Right.hdr, env+x.exr.
glint_status glint_face_files_in_folder(const char *folder, glint_face_files *files,
                                        glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
