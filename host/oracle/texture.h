// The oracle's textures: images, their levels, and look-ups in them, as ARCHITECTURE.md
// ("Textures") and glTF's samplers have them.
#ifndef GLINT_ORACLE_TEXTURE_H
#define GLINT_ORACLE_TEXTURE_H

#include <stdbool.h>

enum { ORACLE_LEVELS = 16 };

// An image and its levels: each has half of the last one's width and height, rounded down, 1 at
// least. texels[level][row × width of the level + column] is linear R, G, B, A; row 0 is at v = 0.
typedef struct oracle_image {
    int width, height, levels;
    double (*texels[ORACLE_LEVELS])[4]; // one block, owned
} oracle_image;

// All texels are 0. False if memory ran out.
bool oracle_image_create(int width, int height, oracle_image *image);
void oracle_image_free(oracle_image *image); // a zeroed one is allowed

// Computes all levels but the first, each as the area mean of the last. With `coverage` R, G and B
// are weighted by A, where there is any.
void oracle_image_average(oracle_image *image, bool coverage);

int oracle_image_side(int size, int level); // width or height of a level

typedef enum oracle_wrap { ORACLE_REPEAT, ORACLE_CLAMP, ORACLE_MIRROR } oracle_wrap;
typedef enum oracle_mips { ORACLE_MIPS_LINEAR, ORACLE_MIPS_NEAREST, ORACLE_MIPS_NONE } oracle_mips;

// How an image is looked up. `image` NULL: there is none.
typedef struct oracle_texture {
    const oracle_image *image;
    int set;             // of texture coordinates, 0 or 1
    oracle_wrap wrap[2]; // of u, of v
    bool magnified_nearest, minified_nearest;
    oracle_mips mips;
    double transform[2][3]; // rows for u′ and v′, of u, v and 1
} oracle_texture;

// Where a ray meets a texture, in texture coordinates that are not transformed yet, and how they
// change where the ray moves aside by 1, along the slant of the surface and across it.
typedef struct oracle_spot {
    double at[2], moved[2][2]; // moved[axis][u, v]
    double width;              // of the pixel's cone here
    int taps;                  // along the ellipse that the pixel sees, at most; 0 means 1
} oracle_spot;

// What a look-up found, and how near it is to one that finds something else.
typedef struct oracle_glance {
    double rgba[4];
    double jump;  // least distance that the ray must move aside to another texel, where texels are
                  // taken whole; INFINITY where they are not
    double turn;  // least relative change of the cone's width that takes another filter
    double slope; // bounds how fast a value changes per distance aside, but for jumps
} oracle_glance;

oracle_glance oracle_look_up(const oracle_texture *texture, const oracle_spot *spot);

#endif
