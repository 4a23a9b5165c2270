// Images on surfaces: what a material says of one, and the images themselves.
#ifndef GLINT_SCENE_TEXTURE_H
#define GLINT_SCENE_TEXTURE_H

#include "base/status.h"
#include "image/formats.h"
#include "kernels/layout.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Texels of a level with its border, and those from a row to the next.
static inline size_t glint_texture_pitch(int width)
{
    return (size_t)width + GLINT_TEXTURE_BORDER;
}

static inline size_t glint_texture_area(int width, int height)
{
    return glint_texture_pitch(width) * ((size_t)height + GLINT_TEXTURE_BORDER);
}

// What a material's textures are for.
typedef enum glint_texture_slot {
    GLINT_TEXTURE_BASE_COLOR =
        GLINT_SLOT_BASE_COLOR, // R, G, B times the base colour; A its coverage
    GLINT_TEXTURE_METALLIC_ROUGHNESS = GLINT_SLOT_METALLIC_ROUGHNESS, // B times metallic, G times
                                                                      // roughness
    GLINT_TEXTURE_OCCLUSION = GLINT_SLOT_OCCLUSION, // R: what is left of the irradiance
    GLINT_TEXTURE_NORMAL = GLINT_SLOT_NORMAL,       // R, G, B: a normal in the tangent's frame
    GLINT_TEXTURE_EMISSION = GLINT_SLOT_EMISSION,   // R, G, B times the emission
    GLINT_TEXTURE_TRANSMISSION = GLINT_SLOT_TRANSMISSION,     // R times transmission
    GLINT_TEXTURE_SPECULAR = GLINT_SLOT_SPECULAR,             // A times specular
    GLINT_TEXTURE_SPECULAR_COLOR = GLINT_SLOT_SPECULAR_COLOR, // R, G, B times specular_color
    GLINT_TEXTURE_CLEARCOAT = GLINT_SLOT_CLEARCOAT,           // R times clearcoat
    GLINT_TEXTURE_CLEARCOAT_ROUGHNESS =
        GLINT_SLOT_CLEARCOAT_ROUGHNESS,                           // G times clearcoat_roughness
    GLINT_TEXTURE_CLEARCOAT_NORMAL = GLINT_SLOT_CLEARCOAT_NORMAL, // as NORMAL, of the coat
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

typedef enum glint_wrap {
    GLINT_WRAP_REPEAT,
    GLINT_WRAP_CLAMP,
    GLINT_WRAP_MIRROR,
} glint_wrap;

typedef enum glint_mip_choice {
    GLINT_MIP_LINEAR, // between two levels
    GLINT_MIP_NEAREST,
    GLINT_MIP_NONE, // the image itself, however small it is seen
} glint_mip_choice;

// How a texture is looked up. Zero is valid: glTF's default.
typedef struct glint_texture_use {
    uint32_t image; // its place in the textures, from 1; 0: none
    int texcoord;   // the set of texture coordinates, 0 or 1
    glint_wrap wrap_s, wrap_t;
    bool magnified_nearest, minified_nearest; // else bilinear
    glint_mip_choice mips;
    // KHR_texture_transform: u' = transform[0] u + transform[1] v + transform[2], v' likewise from
    // the other three. All zero: none.
    float transform[6];
} glint_texture_use;

// An image and its levels: each has half of the last one's width and height, rounded down, 1 at
// least. Values are linear, as whole numbers of 1/65535, R, G, B, A; row 0 is at the top, v = 0.
// kernels/layout.h says how texels stand.
typedef struct glint_texture {
    int width, height, levels;
    size_t first[GLINT_TEXTURE_LEVELS]; // where each level begins, in texels of all textures
} glint_texture;

// The images of a file. Several scenes may share them: the last one frees them.
typedef struct glint_textures {
    size_t count;
    glint_texture *textures; // owned
    size_t texel_count;
    uint16_t (*texels)[4]; // owned, aligned to GLINT_ALIGNMENT
    unsigned owners;       // counted atomically
} glint_textures;

// What an image is read for.
typedef struct glint_texture_request {
    glint_image_source source;
    bool is_color;    // its R, G and B have the sRGB curve
    bool is_coverage; // its A is coverage: transparent texels count less in coarser levels
    int threads;      // that compute its levels; 0: one for each core
} glint_texture_request;

// The levels of one image, in memory of its own.
typedef struct glint_texture_levels {
    glint_texture texture; // `first` counts from this image's first texel
    size_t texel_count;
    uint16_t (*texels)[4]; // owned
} glint_texture_levels;

// Decodes an image and computes its levels. Levels wider or higher than `largest` texels are left
// out; 0: none are. What the file says of its colour space and orientation does not count, as glTF
// asks. Errors: GLINT_BAD_INPUT with the source's name; GLINT_OUT_OF_MEMORY.
glint_status glint_texture_read(const glint_texture_request *request, int largest,
                                glint_texture_levels *levels, glint_error *error);

// Puts images into one array, and frees theirs; *textures has one owner. Errors:
// GLINT_OUT_OF_MEMORY.
glint_status glint_textures_join(glint_texture_levels *images, size_t count,
                                 glint_textures **textures, glint_error *error);

// What the texels take; 0 of NULL.
size_t glint_textures_bytes(const glint_textures *textures);

// One owner more, and one less; NULL is allowed.
glint_textures *glint_textures_share(glint_textures *textures);
void glint_textures_release(glint_textures *textures);

#ifdef __cplusplus
}
#endif

#endif
