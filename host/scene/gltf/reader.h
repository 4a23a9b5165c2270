// Reads glTF files into documents (scene/document.h).
#ifndef GLINT_SCENE_GLTF_READER_H
#define GLINT_SCENE_GLTF_READER_H

#include "base/status.h"

// Reads a .gltf or .glb file with all that it refers to, but for images beside it. *file is a
// memory file that holds the document; the caller closes it. Errors, without the file's name:
// GLINT_BAD_INPUT, GLINT_OUT_OF_MEMORY; *file is then −1.
glint_status glint_reader_run(const char *path, int *file, glint_error *error);

#endif
