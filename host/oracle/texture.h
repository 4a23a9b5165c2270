// Looks up textures: images and their levels. Follows docs/light_transport.md ("Textures") and
// glTF's samplers.
#ifndef GLINT_ORACLE_TEXTURE_H
#define GLINT_ORACLE_TEXTURE_H

#include <stdbool.h>

enum { ORACLE_LEVELS = 16 };

// An image and its levels. Each level has half of the width and height before, rounded down, but at
// least 1. texels[level][row × width of the level + column] is linear R, G, B, A; row 0 is at v =
// 0.
typedef struct oracle_image {
    int width, height, levels;
    double (*texels[ORACLE_LEVELS])[4]; // one block, owned
} oracle_image;

// Makes an image whose texels are all 0. Returns false if memory ran out.
bool oracle_image_create(int width, int height, oracle_image *image);
void oracle_image_free(oracle_image *image); // a zeroed image is allowed

// Computes all levels after the first, each as the area mean of the level before. With `coverage`,
// A weighs R, G and B where A is not 0 everywhere.
void oracle_image_average(oracle_image *image, bool coverage);

int oracle_image_side(int size, int level); // width or height of a level

typedef enum oracle_wrap { ORACLE_REPEAT, ORACLE_CLAMP, ORACLE_MIRROR } oracle_wrap;
typedef enum oracle_mips { ORACLE_MIPS_LINEAR, ORACLE_MIPS_NEAREST, ORACLE_MIPS_NONE } oracle_mips;

// A texture: an image and its sampler. `image` is NULL if there is no texture.
typedef struct oracle_texture {
    const oracle_image *image;
    int set;             // which texture coordinates, 0 or 1
    oracle_wrap wrap[2]; // for u, for v
    bool magnified_nearest, minified_nearest;
    oracle_mips mips;
    double transform[2][3]; // rows for u′ and v′, of u, v and 1
} oracle_texture;

// The place where a ray meets a texture, in untransformed texture coordinates. `moved` is the
// change of the place if the ray moves aside by 1, along the surface's slant and across it.
typedef struct oracle_spot {
    double at[2], moved[2][2]; // moved[axis][u, v]
    double width;              // width of the pixel's cone here
    int taps;                  // most taps along the pixel's ellipse; 0 means 1
} oracle_spot;

// The result of a look-up, and its distance to a jump.
typedef struct oracle_glance {
    double rgba[4];
    // With nearest texels: the least distance that the ray must move aside to another texel. Else
    // INFINITY.
    double jump;
    double turn;  // least relative change of the cone's width that selects another filter
    double slope; // bounds the value's change per distance aside, without jumps
} oracle_glance;

oracle_glance oracle_look_up(const oracle_texture *texture, const oracle_spot *spot);

#endif
