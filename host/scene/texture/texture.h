// Images on surfaces: how a material uses a texture, and the images themselves.
#ifndef GLINT_SCENE_TEXTURE_TEXTURE_H
#define GLINT_SCENE_TEXTURE_TEXTURE_H

#include "base/status.h"
#include "image/formats.h"
#include "kernels/layout.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Texels from one row of a level to the next; and texels of a whole level with its border.
static inline size_t glint_texture_pitch(int width)
{
    return (size_t)width + GLINT_TEXTURE_BORDER;
}

static inline size_t glint_texture_area(int width, int height)
{
    return glint_texture_pitch(width) * ((size_t)height + GLINT_TEXTURE_BORDER);
}

// The purposes of a material's textures, and how the channels apply.
typedef enum glint_texture_slot {
    GLINT_TEXTURE_BASE_COLOR =
        GLINT_SLOT_BASE_COLOR, // R, G, B times the base colour; A its coverage
    GLINT_TEXTURE_METALLIC_ROUGHNESS = GLINT_SLOT_METALLIC_ROUGHNESS, // B times metallic, G times
                                                                      // roughness
    GLINT_TEXTURE_OCCLUSION = GLINT_SLOT_OCCLUSION,                   // R scales the irradiance
    GLINT_TEXTURE_NORMAL = GLINT_SLOT_NORMAL,             // R, G, B: a normal in the tangent frame
    GLINT_TEXTURE_EMISSION = GLINT_SLOT_EMISSION,         // R, G, B times the emission
    GLINT_TEXTURE_TRANSMISSION = GLINT_SLOT_TRANSMISSION, // R times transmission
    GLINT_TEXTURE_SPECULAR = GLINT_SLOT_SPECULAR,         // A times specular
    GLINT_TEXTURE_SPECULAR_COLOR = GLINT_SLOT_SPECULAR_COLOR, // R, G, B times specular_color
    GLINT_TEXTURE_CLEARCOAT = GLINT_SLOT_CLEARCOAT,           // R times clearcoat
    GLINT_TEXTURE_CLEARCOAT_ROUGHNESS =
        GLINT_SLOT_CLEARCOAT_ROUGHNESS,                           // G times clearcoat_roughness
    GLINT_TEXTURE_CLEARCOAT_NORMAL = GLINT_SLOT_CLEARCOAT_NORMAL, // as NORMAL, for the coat
    GLINT_TEXTURE_IRIDESCENCE = GLINT_SLOT_IRIDESCENCE,           // R times iridescence
    GLINT_TEXTURE_IRIDESCENCE_THICKNESS = GLINT_SLOT_IRIDESCENCE_THICKNESS, // G, see material.h
    GLINT_TEXTURE_ANISOTROPY = GLINT_SLOT_ANISOTROPY,   // R, G a direction; B times anisotropy
    GLINT_TEXTURE_SHEEN_COLOR = GLINT_SLOT_SHEEN_COLOR, // R, G, B times sheen_color
    GLINT_TEXTURE_SHEEN_ROUGHNESS = GLINT_SLOT_SHEEN_ROUGHNESS, // A times sheen_roughness
    // A times diffuse_transmission; R, G, B times its colour
    GLINT_TEXTURE_DIFFUSE_TRANSMISSION = GLINT_SLOT_DIFFUSE_TRANSMISSION,
    GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR = GLINT_SLOT_DIFFUSE_TRANSMISSION_COLOR,
    GLINT_TEXTURE_SLOTS = GLINT_MATERIAL_TEXTURES
} glint_texture_slot;

const char *glint_texture_slot_name(glint_texture_slot slot); // "base colour"

// True if R, G and B are encoded by the sRGB curve.
bool glint_texture_slot_is_color(glint_texture_slot slot);

typedef enum glint_wrap {
    GLINT_WRAP_REPEAT,
    GLINT_WRAP_CLAMP,
    GLINT_WRAP_MIRROR,
} glint_wrap;

typedef enum glint_mip_choice {
    GLINT_MIP_LINEAR, // interpolates between two levels
    GLINT_MIP_NEAREST,
    GLINT_MIP_NONE, // always the full image, however small it appears
} glint_mip_choice;

// How a texture is sampled. Zero is valid: glTF's default.
typedef struct glint_texture_use {
    uint32_t image; // index of the image in the textures, from 1; 0: none
    int texcoord;   // the set of texture coordinates, 0 or 1
    glint_wrap wrap_s, wrap_t;
    bool magnified_nearest, minified_nearest; // false: bilinear
    glint_mip_choice mips;
    // KHR_texture_transform: u' = transform[0] u + transform[1] v + transform[2]; v' from the other
    // three in the same way. All zero: no transform.
    float transform[6];
} glint_texture_use;

// An image and its mip levels. Each level has half the width and height of the last, rounded down,
// at least 1. Values are linear, in units of 1/65535, R, G, B, A; row 0 is at the top, v = 0.
// kernels/layout.h describes the order of the texels.
typedef struct glint_texture {
    int width, height, levels;
    size_t first[GLINT_TEXTURE_LEVELS]; // start of each level, in texels of all textures
} glint_texture;

// The images of a file. Several scenes may share them: the last one frees them.
typedef struct glint_textures {
    size_t count;
    glint_texture *textures; // owned
    size_t texel_count;
    uint16_t (*texels)[4]; // owned, aligned to GLINT_ALIGNMENT
    unsigned owners;       // counted atomically
} glint_textures;

// The levels of one image, with their own memory.
typedef struct glint_texture_levels {
    glint_texture texture; // `first` counts from this image's first texel
    size_t texel_count;
    uint16_t (*texels)[4]; // owned
} glint_texture_levels;

// Moves images into one array and frees their own memory; *textures has one owner. Errors:
// GLINT_OUT_OF_MEMORY.
glint_status glint_textures_join(glint_texture_levels *images, size_t count,
                                 glint_textures **textures, glint_error *error);

// Returns the bytes of the texels; 0 for NULL.
size_t glint_textures_bytes(const glint_textures *textures);

// Adds an owner, and removes an owner; NULL is allowed.
glint_textures *glint_textures_share(glint_textures *textures);
void glint_textures_release(glint_textures *textures);

#ifdef __cplusplus
}
#endif

#endif
