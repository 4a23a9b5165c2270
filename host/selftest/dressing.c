// Gives scenes textures and attributes by formula. See dressing.h.
#include "selftest/dressing.h"

#include "base/memory.h"
#include "oracle/texture.h"

#include <math.h>
#include <stdlib.h>

// ---- Images -------------------------------------------------------------------------------------

static const int image_sizes[DRESSING_IMAGES][2] = {{16, 16}, {12, 8}, {9, 5}, {16, 16}};

// A texel. It differs from its neighbours by a few tenths, differently in each channel.
static double texel(int image, int x, int y, int channel)
{
    const double w = image_sizes[image][0], h = image_sizes[image][1];
    const double wave = sin(2 * GLINT_PI * (x * (1 + channel) / w + 0.13 * image)) *
                        cos(2 * GLINT_PI * (y * (1 + channel % 2) / h + 0.31 * channel));
    return 0.6 + 0.4 * wave;
}

// Copies a level with its border.
static void copy_level(const oracle_image *image, int level, uint16_t (*texels)[4])
{
    const int width = oracle_image_side(image->width, level);
    const int height = oracle_image_side(image->height, level);
    for (int y = 0; y <= height; y++) {
        for (int x = 0; x <= width; x++, texels++) {
            const double *from = image->texels[level][y % height * width + x % width];
            for (int c = 0; c < 4; c++) {
                (*texels)[c] = (uint16_t)lround(from[c] * 65535);
            }
        }
    }
}

static glint_status fill_image(int number, glint_texture_levels *levels, glint_error *error)
{
    oracle_image image;
    if (!oracle_image_create(image_sizes[number][0], image_sizes[number][1], &image)) {
        return glint_fail_memory(error, "a self-test");
    }
    for (int i = 0; i < image.width * image.height; i++) {
        for (int c = 0; c < 4; c++) {
            image.texels[0][i][c] = texel(number, i % image.width, i / image.width, c);
        }
    }
    oracle_image_average(&image, number == DRESSING_COVERAGE);
    glint_texture *t = &levels->texture;
    *t = (glint_texture){.width = image.width, .height = image.height, .levels = image.levels};
    for (int level = 0; level < image.levels; level++) {
        t->first[level] = levels->texel_count;
        levels->texel_count += glint_texture_area(oracle_image_side(image.width, level),
                                                  oracle_image_side(image.height, level));
    }
    levels->texels = glint_allocate_unset(levels->texel_count, sizeof *levels->texels);
    for (int level = 0; levels->texels != NULL && level < image.levels; level++) {
        copy_level(&image, level, levels->texels + t->first[level]);
    }
    oracle_image_free(&image);
    return levels->texels != NULL ? GLINT_OK : glint_fail_memory(error, "a self-test");
}

glint_status dressing_add_images(glint_scene *scene, glint_error *error)
{
    glint_texture_levels levels[DRESSING_IMAGES] = {0};
    glint_status status;
    for (int i = 0; i < DRESSING_IMAGES; i++) {
        TRY_OR(cleanup, status, fill_image(i, &levels[i], error));
    }
    TRY_OR(cleanup, status, glint_textures_join(levels, DRESSING_IMAGES, &scene->textures, error));
cleanup:
    for (int i = 0; i < DRESSING_IMAGES; i++) {
        free(levels[i].texels);
    }
    return status;
}

glint_texture_use dressing_use(int image, int variant)
{
    glint_texture_use use = {.image = (uint32_t)image + 1,
                             .texcoord = variant / 2 % 2,
                             .wrap_s = (glint_wrap)(variant % 3),
                             .wrap_t = (glint_wrap)((variant / 3 + variant) % 3),
                             .magnified_nearest = variant % 5 == 1,
                             .minified_nearest = variant % 5 == 3,
                             .mips = (glint_mip_choice)(variant / 2 % 3)};
    const double angle = 0.4 * variant, c = cos(angle), s = sin(angle);
    const double transform[6] = {0.9 * c, 1.2 * s, 0.3, -0.9 * s, 1.2 * c, -0.2};
    for (int i = 0; variant % 4 != 0 && i < 6; i++) {
        use.transform[i] = (float)transform[i];
    }
    return use;
}

// ---- Attributes ---------------------------------------------------------------------------------

enum { CORNER = 12 }; // numbers of a corner, in the order of glint_attributes

// Makes a unit vector at right angles to the normal. The normal may be 0.
static void make_tangent(const float *normal, double tangent[3])
{
    static const double toward[3] = {0.2, 0.3, 0.9};
    double along = 0, squares = 0;
    for (int k = 0; k < 3; k++) {
        along += toward[k] * (double)normal[k];
    }
    for (int k = 0; k < 3; k++) {
        tangent[k] = toward[k] - along * (double)normal[k];
        squares += tangent[k] * tangent[k];
    }
    for (int k = 0; k < 3; k++) {
        tangent[k] /= sqrt(squares);
    }
}

static void fill_corner(const glint_scene *scene, size_t corner, int even, float *stored)
{
    const float *p = scene->positions + 3 * corner;
    const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
    const bool is_even = (int)scene->material_of[corner / 3] == even;
    double values[CORNER] = {1.3 * x + 0.4 * y + 0.2 * z,
                             0.3 * x - 1.1 * y + 1.4 * z,
                             0.8 * y - 1.2 * z + 0.5,
                             1.5 * x + 0.3 * y - 0.4 * z,
                             0.75 + 0.25 * x,
                             0.75 - 0.25 * y,
                             0.75 + 0.25 * z,
                             is_even ? 1 : 0.6 + 0.3 * x - 0.2 * y};
    make_tangent(scene->normals + 3 * corner, values + 8);
    values[11] = corner / 3 % 2 == 0 ? 1 : -1; // side of the bitangent
    for (int i = 0; i < CORNER; i++) {
        stored[i] = (float)values[i];
    }
}

glint_status dressing_add_attributes(glint_scene *scene, int even, glint_error *error)
{
    scene->attribute_set = (glint_attributes){true, true, true, true};
    const size_t corners = 3 * scene->triangle_count;
    scene->attributes = glint_allocate(CORNER * corners, sizeof *scene->attributes);
    if (scene->attributes == NULL) {
        return glint_fail_memory(error, "a self-test");
    }
    for (size_t i = 0; i < corners; i++) {
        fill_corner(scene, i, even, scene->attributes + CORNER * i);
    }
    return GLINT_OK;
}
