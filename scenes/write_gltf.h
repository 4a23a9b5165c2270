// Writes a scene as glTF 2.0: NAME.gltf, NAME.bin and a PNG for each picture.
#ifndef GLINT_SCENES_WRITE_GLTF_H
#define GLINT_SCENES_WRITE_GLTF_H

#include "model.h"

// Writes the files. The same scene gives the same bytes: numbers have at most nine digits in any
// locale, and the binary part is little-endian. Errors: GLINT_MISMATCH (see model_check),
// GLINT_OUTPUT_FAILED.
glint_status write_gltf(const model *scene, const char *folder, glint_error *error);

#endif
