// Reads images.
#ifndef GLINT_SCENE_TEXTURE_TEXTURE_READ_H
#define GLINT_SCENE_TEXTURE_TEXTURE_READ_H

#include "scene/texture/texture_levels.h"

// Decodes an image and computes its levels. Leaves out levels wider or higher than `largest`
// texels; 0: no limit. Ignores the file's colour space and orientation, as glTF requires. Errors:
// GLINT_BAD_INPUT with the source's name; GLINT_OUT_OF_MEMORY.
glint_status glint_texture_read(const glint_texture_request *request, int largest,
                                glint_texture_levels *levels, glint_error *error);

#endif
