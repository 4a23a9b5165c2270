// Reads the textures of a glTF file by the tests' own code, in double precision: JSON, samplers,
// the meaning of texel values, and mip levels. Only the decoding of images is glint's.
#ifndef GLINT_TESTS_SUPPORT_FILE_TEXTURES_H
#define GLINT_TESTS_SUPPORT_FILE_TEXTURES_H

#include "oracle/oracle.h"
#include "scene/scene.h"

typedef struct file_textures file_textures;

// Reads the textures of the scene's materials from its file and gives them to the oracle's
// materials, in the same order. Images must be files. Fails the running test on any error.
file_textures *file_textures_read(const glint_scene *scene, oracle_material *materials);
void file_textures_free(file_textures *textures);

#endif
