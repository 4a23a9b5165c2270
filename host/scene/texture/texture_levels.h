// Computes the mip levels of an image.
#ifndef GLINT_SCENE_TEXTURE_TEXTURE_LEVELS_H
#define GLINT_SCENE_TEXTURE_TEXTURE_LEVELS_H

#include "image/decoder.h"
#include "scene/texture/texture.h"

// Makes all levels of an image of 8 or 16 bits, on request->threads threads. Each texel is the area
// mean of the next finer level, rounded once, by at most half of 1/65535. Errors: GLINT_BAD_INPUT
// with the image's name, GLINT_OUT_OF_MEMORY; the caller frees *levels in any case.
glint_status glint_texture_levels_make(const glint_texture_request *request,
                                       const glint_stored *stored, glint_texture_levels *levels,
                                       glint_error *error);

#endif
