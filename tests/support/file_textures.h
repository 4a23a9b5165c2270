// The textures of a glTF file, read by code of the tests' own: the JSON, the samplers, the meaning
// of the images' codes, and the levels, in double precision. Only the images are decoded as glint
// decodes them.
#ifndef GLINT_TESTS_SUPPORT_FILE_TEXTURES_H
#define GLINT_TESTS_SUPPORT_FILE_TEXTURES_H

#include "oracle/oracle.h"
#include "scene/scene.h"

typedef struct file_textures file_textures;

// Reads the textures that the scene's materials have in its file, and gives them to the oracle's
// materials, in the same order. Images must be files. Fails the running test if anything goes
// wrong.
file_textures *file_textures_read(const glint_scene *scene, oracle_material *materials);
void file_textures_free(file_textures *textures);

#endif
