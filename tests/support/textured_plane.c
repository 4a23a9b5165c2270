// Shows a textured plane at a slant. See textured_plane.h.
#include "support/textured_plane.h"

#include "image/image_io.h"
#include "support/gltf_text.h"
#include "support/scratch.h"
#include "support/srgb.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

const textured_plane the_plane = {
    .positions = {{-4, 0, 2}, {4, 0, 2}, {4, 0, -14}, {-4, 0, -14}},
    .normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}},
    .first = {{0, 2}, {2, 2}, {2, 0}, {0, 0}},
    .second = {{1, 0}, {0, 0}, {0, 1}, {1, 1}},
    .tangents = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}},
    .colors = {{1, 0.5F, 0.25F, 1}, {1, 0.5F, 0.25F, 1}, {0.5F, 1, 0.25F, 1}, {0.5F, 1, 0.25F, 1}},
    .indices = {0, 1, 2, 0, 2, 3}};

glint_scene textured_plane_load(const char *folder, const char *format, ...)
{
    char rest[6000] = PLANE;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(rest + strlen(rest), sizeof rest - strlen(rest), format, arguments);
    va_end(arguments);
    return load_rest(folder, &the_plane, sizeof the_plane, rest);
}

bool textured_plane_meet(const glint_settings *settings, int pixel, meeting *m)
{
    const int column = pixel % settings->width, row = pixel / settings->width;
    const double half = tan(PLANE_YFOV / 2), turn = -2 * asin(0.19866933);
    const double x =
        (2 * (column + 0.5) / settings->width - 1) * half * settings->width / settings->height;
    const double y = (1 - 2 * (row + 0.5) / settings->height) * half;
    const double d[3] = {x, y * cos(turn) + sin(turn), y * sin(turn) - cos(turn)};
    const double norm = sqrt(x * x + y * y + 1);
    const double t = -1.5 / d[1];
    *m = (meeting){
        .at = {t * d[0], 3 + t * d[2]}, .length = t * norm, .cosine = -d[1] / norm, .slant = norm};
    return t > 0 && fabs(m->at[0]) < 4 && m->at[1] < 2 && m->at[1] > -14;
}

void write_codes(const char *name, const int size[2], const unsigned char (*codes)[4])
{
    glint_image image;
    assert_int_equal(glint_image_create(size[0], size[1], 4, &image, NULL), GLINT_OK);
    for (int i = 0; i < size[0] * size[1]; i++) {
        const float alpha = (float)codes[i][3] / 255.0F;
        for (int c = 0; c < 3; c++) {
            image.pixels[4 * i + c] = alpha * (float)linear_from_srgb(codes[i][c] / 255.0);
        }
        image.pixels[4 * i + 3] = alpha;
    }
    assert_int_equal(glint_image_write(scratch_path(name), &image, NULL, NULL), GLINT_OK);
    glint_image_free(&image);
}
