// Makes maps whose colour encodes direction. See direction_maps.h.
#include "support/direction_maps.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

double next_random(void)
{
    static uint64_t seed = 88172645463325252u;
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (double)(seed >> 11) / 9007199254740992.0 * 2.0 - 1.0;
}

glint_vec3 random_direction(void)
{
    for (;;) {
        glint_vec3 d = {next_random(), next_random(), next_random()};
        double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
        if (length > 0.1 && length <= 1.0) {
            return (glint_vec3){d.x / length, d.y / length, d.z / length};
        }
    }
}

glint_environment load_environment(const char *path, glint_layout layout, glint_warnings *warnings)
{
    glint_environment environment;
    glint_error error = {0};
    const glint_layout_request request = {.layout = layout};
    if (glint_environment_load(path, &request, &environment, warnings, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    return environment;
}

void color_of(glint_vec3 d, double rgb[3])
{
    double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    rgb[0] = 0.5 + 0.5 * d.x / length;
    rgb[1] = 0.5 + 0.5 * d.y / length;
    rgb[2] = 0.5 + 0.5 * d.z / length;
}

// See direction_maps.h.
double error_along(const glint_cube *cube, glint_vec3 d)
{
    double found[3], wanted[3], worst = 0.0;
    glint_cube_sample(cube, d, found);
    color_of(d, wanted);
    for (int c = 0; c < 3; c++) {
        worst = fmax(worst, fabs(found[c] - wanted[c]));
    }
    return isfinite(found[0] + found[1] + found[2]) ? worst : INFINITY;
}

// See direction_maps.h. Hard directions are axes, edges, corners and their neighbourhoods.
double worst_error(const glint_cube *cube)
{
    double worst = 0.0;
    for (int i = 0; i < 20000; i++) {
        worst = fmax(worst, error_along(cube, random_direction()));
    }
    const double near[] = {0.0, 1e-12, 1e-6, 1e-3, 0.999, 1.0 - 1e-9, 1.0};
    for (int i = 0; i < 7 * 7 * 8 * 3; i++) {
        double a = near[i % 7] * (i / 49 % 2 ? 1 : -1), b = near[i / 7 % 7] * (i / 98 % 2 ? 1 : -1);
        double c = i / 196 % 2 ? 1.0 : -1.0;
        int axis = i / 392;
        glint_vec3 d = axis == 0   ? (glint_vec3){c, a, b}
                       : axis == 1 ? (glint_vec3){a, c, b}
                                   : (glint_vec3){a, b, c};
        worst = fmax(worst, error_along(cube, d));
    }
    return worst;
}

// Texels are 2/N apart. Bilinear interpolation of 0.5 + 0.5 d errs by up to (2/N)²/8 of the second
// derivatives in s and t. For a component of a unit vector each is at most 1 in size: 0.5 (0.5 +
// 0.5)/N². Halfway over an edge, the mean of two unit vectors is too short by the square of their
// angle over 8, at most (√2/N)²/8 of 0.5. Hard case 26 allows 2/N² for d, 1/N² for 0.5 d.
double seam_bound(int edge)
{
    return 1.0 / ((double)edge * edge);
}

// The direction of OpenEXR's cube (ImfEnvmap.h) at pixel (column, row) in [0, 1], face by face.
glint_vec3 openexr_cube_direction(int face, double column, double row)
{
    double across = 2.0 * column - 1.0, down = 2.0 * row - 1.0;
    switch (face) {
    case 0:
        return (glint_vec3){1.0, -down, across};
    case 1:
        return (glint_vec3){-1.0, -down, -across};
    case 2:
        return (glint_vec3){across, 1.0, -down};
    case 3:
        return (glint_vec3){across, -1.0, down};
    case 4:
        return (glint_vec3){-across, -down, 1.0};
    default:
        return (glint_vec3){across, -down, -1.0};
    }
}

// OpenEXR's lat-long map: u = 0 at the left, v = 0 at the top, both in [0, 1].
glint_vec3 latlong_direction(double u, double v)
{
    double longitude = -2.0 * GLINT_PI * (u - 0.5), latitude = GLINT_PI * (0.5 - v);
    return (glint_vec3){sin(longitude) * cos(latitude), sin(latitude),
                        cos(longitude) * cos(latitude)};
}

glint_image direction_latlong(int height, bool on_edges)
{
    glint_image image;
    int width = 2 * height;
    assert_int_equal(glint_image_create(width, height, 3, &image, NULL), GLINT_OK);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            double u = on_edges ? x / (width - 1.0) : (x + 0.5) / width;
            double v = on_edges ? y / (height - 1.0) : (y + 0.5) / height;
            double rgb[3];
            color_of(latlong_direction(u, v), rgb);
            for (int c = 0; c < 3; c++) {
                glint_image_pixel(&image, x, y)[c] = (float)rgb[c];
            }
        }
    }
    return image;
}

// Second derivatives of d by longitude and latitude are at most 1. With spacing π/H, two axes and
// the colour's half, each contributes (π/H)²/8. Maps with texels on the edges have spacings of at
// most 2π/(2H − 1) and π/(H − 1).
double latlong_bound(int height, bool on_edges)
{
    double h = GLINT_PI / (on_edges ? height - 1 : height);
    return 0.125 * h * h + 1e-7;
}

// OpenGL's table: the face is chosen by the major axis, s = (sc/|ma| + 1)/2, t = (tc/|ma| + 1)/2,
// t = 0 being the picture's first row. Solved for the direction (rx, ry, rz).
glint_vec3 opengl_direction(int face, double s, double t)
{
    double sc = 2.0 * s - 1.0, tc = 2.0 * t - 1.0;
    switch (face) {
    case 0: // +rx: sc = −rz, tc = −ry
        return (glint_vec3){1.0, -tc, -sc};
    case 1: // −rx: sc = +rz, tc = −ry
        return (glint_vec3){-1.0, -tc, sc};
    case 2: // +ry: sc = +rx, tc = +rz
        return (glint_vec3){sc, 1.0, tc};
    case 3: // −ry: sc = +rx, tc = −rz
        return (glint_vec3){sc, -1.0, -tc};
    case 4: // +rz: sc = +rx, tc = −ry
        return (glint_vec3){sc, -tc, 1.0};
    default: // −rz: sc = −rx, tc = −ry
        return (glint_vec3){-sc, -tc, -1.0};
    }
}
