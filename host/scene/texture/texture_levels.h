// Computes the mip levels of an image.
#ifndef GLINT_SCENE_TEXTURE_TEXTURE_LEVELS_H
#define GLINT_SCENE_TEXTURE_TEXTURE_LEVELS_H

#include "image/decoder.h"
#include "scene/texture/texture.h"

// An image to read, and its use.
typedef struct glint_texture_request {
    glint_image_source source;
    bool is_color;    // R, G and B are encoded by the sRGB curve
    bool is_coverage; // A is coverage: transparent texels count less in coarser levels
    int threads;      // threads that compute its levels; 0: one per core
} glint_texture_request;

// Makes all levels of an image of 8 or 16 bits, on request->threads threads. Each texel is the area
// mean of the next finer level, rounded once, by at most half of 1/65535. Errors: GLINT_BAD_INPUT
// with the image's name, GLINT_OUT_OF_MEMORY; the caller frees *levels in any case.
glint_status glint_texture_levels_make(const glint_texture_request *request,
                                       const glint_stored *stored, glint_texture_levels *levels,
                                       glint_error *error);

#endif
