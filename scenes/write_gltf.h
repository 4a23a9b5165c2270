// Writes a scene as glTF 2.0: NAME.gltf and, beside it, NAME.bin and a PNG for each picture.
#ifndef GLINT_SCENES_WRITE_GLTF_H
#define GLINT_SCENES_WRITE_GLTF_H

#include "model.h"

// The same scene gives the same bytes: numbers have nine digits at most, whatever the locale, and
// the binary part is little-endian. Errors: GLINT_MISMATCH (see model_check), GLINT_OUTPUT_FAILED.
glint_status write_gltf(const model *scene, const char *folder, glint_error *error);

#endif
