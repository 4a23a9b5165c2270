// Converts glint's scenes to the oracle's. See bridge.h.
#include "support/bridge.h"

#include "kernels/layout.h"
#include "selftest/judge.h"
#include "support/file_textures.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

struct bridge {
    judge judge;                  // the scene, with its light
    file_textures *textures;      // NULL: use the textures of the judge
    const glint_cube *cube, *map; // radiance; irradiance, or NULL
    // All texels as vectors: direction, and colour times solid angle over π.
    double (*directions)[3], (*weighted)[3];
    int texel_count;
    double *tie; // see bridge_take_tie; a pointer, because look-ups get a const bridge
};

static const int s_axis[6] = GLINT_CUBE_S_AXIS, s_sign[6] = GLINT_CUBE_S_SIGN;
static const int t_axis[6] = GLINT_CUBE_T_AXIS, t_sign[6] = GLINT_CUBE_T_SIGN;

static void texel_direction(int face, double s, double t, double d[3])
{
    d[face / 2] = face % 2 ? -1 : 1;
    d[s_axis[face]] = s * s_sign[face];
    d[t_axis[face]] = t * t_sign[face];
    double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; k++) {
        d[k] /= length;
    }
}

// Interpolates bilinearly in the face of the largest component. The border of one texel is part of
// the data.
static void look_up(const bridge *b, const glint_cube *cube, const double d[3], double rgb[3])
{
    int face = 0;
    double most = -1, next = -1;
    for (int f = 0; f < 6; f++) {
        double along = d[f / 2] * (f % 2 ? -1 : 1);
        if (along > most) {
            next = most;
            most = along;
            face = f;
        } else if (along > next) {
            next = along;
        }
    }
    *b->tie = fmin(*b->tie, most - next);
    double n = cube->edge;
    double x = (d[s_axis[face]] * s_sign[face] / most + 1) / 2 * n + 0.5;
    double y = (d[t_axis[face]] * t_sign[face] / most + 1) / 2 * n + 0.5;
    int i = (int)floor(x), j = (int)floor(y);
    size_t pitch = (size_t)cube->edge + 2;
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int corner = 0; corner < 4; corner++) {
            int right = corner & 1, down = corner >> 1;
            size_t texel =
                ((size_t)face * pitch + (size_t)(j + down)) * pitch + (size_t)(i + right);
            double weight = (right ? x - i : 1 - (x - i)) * (down ? y - j : 1 - (y - j));
            sum += weight * (double)cube->texels[4 * texel + (size_t)k];
        }
        rgb[k] = sum;
    }
}

static void look_up_radiance(const void *context, const double d[3], double rgb[3])
{
    const bridge *b = context;
    look_up(b, b->cube, d, rgb);
}

static void find_irradiance(const void *context, const double n[3], double rgb[3])
{
    const bridge *b = context;
    if (b->map != NULL) {
        look_up(b, b->map, n, rgb);
        return;
    }
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int i = 0; i < b->texel_count; i++) {
        const double *d = b->directions[i];
        double cosine = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
        for (int k = 0; cosine > 0 && k < 3; k++) {
            rgb[k] += cosine * b->weighted[i][k];
        }
    }
}

// The solid angle between the axis and (x, y) on the face's plane at distance 1.
static double corner_angle(double x, double y)
{
    return atan2(x * y, sqrt(x * x + y * y + 1));
}

static void weigh_texels(bridge *b)
{
    int n = b->cube->edge;
    size_t pitch = (size_t)n + 2;
    b->texel_count = 6 * n * n;
    b->directions = calloc((size_t)b->texel_count, sizeof *b->directions);
    b->weighted = calloc((size_t)b->texel_count, sizeof *b->weighted);
    assert_non_null(b->directions);
    assert_non_null(b->weighted);
    for (int texel = 0; texel < b->texel_count; texel++) {
        int face = texel / (n * n), j = texel / n % n, i = texel % n;
        double x0 = 2.0 * i / n - 1, x1 = 2.0 * (i + 1) / n - 1;
        double y0 = 2.0 * j / n - 1, y1 = 2.0 * (j + 1) / n - 1;
        double angle = corner_angle(x1, y1) - corner_angle(x0, y1) - corner_angle(x1, y0) +
                       corner_angle(x0, y0);
        texel_direction(face, (x0 + x1) / 2, (y0 + y1) / 2, b->directions[texel]);
        const float *color =
            b->cube->texels + 4 * (((size_t)face * pitch + (size_t)j + 1) * pitch + (size_t)i + 1);
        for (int k = 0; k < 3; k++) {
            b->weighted[texel][k] = (double)color[k] * angle / GLINT_PI;
        }
    }
}

bridge *bridge_create(const glint_scene *scene, const glint_environment *environment)
{
    bridge *b = calloc(1, sizeof *b);
    assert_non_null(b);
    b->cube = &environment->radiance;
    assert_int_equal(judge_begin(scene, &b->judge, NULL), GLINT_OK);
    weigh_texels(b);
    b->tie = malloc(sizeof *b->tie);
    assert_non_null(b->tie);
    *b->tie = INFINITY;
    b->judge.scene.radiance = look_up_radiance;
    b->judge.scene.irradiance = find_irradiance;
    b->judge.scene.context = b;
    return b;
}

void bridge_read_textures(bridge *b, const glint_scene *scene)
{
    b->textures = file_textures_read(scene, b->judge.materials);
}

void bridge_free(bridge *b)
{
    if (b->textures != NULL) {
        file_textures_free(b->textures);
    }
    judge_end(&b->judge);
    free(b->directions);
    free(b->weighted);
    free(b->tie);
    free(b);
}

const oracle_scene *bridge_scene(const bridge *b)
{
    return &b->judge.scene;
}

void bridge_use_irradiance_map(bridge *b, const glint_cube *map)
{
    b->map = map;
}

double bridge_take_tie(const bridge *b)
{
    const double tie = *b->tie;
    *b->tie = INFINITY;
    return tie;
}

oracle_view bridge_view(const glint_camera *camera, const glint_settings *settings)
{
    oracle_view view = judge_view(camera, settings);
    view.depth = settings->depth;
    view.min_weight = settings->min_weight;
    view.no_fresnel = settings->fresnel == GLINT_FRESNEL_NONE;
    view.transparent = settings->transparent;
    view.edges = true;
    return view;
}

void bridge_direction_environment(int edge, glint_environment *environment)
{
    *environment = (glint_environment){0};
    glint_cube *cube = &environment->radiance;
    assert_int_equal(glint_cube_create(edge, cube, NULL), GLINT_OK);
    for (int face = 0; face < 6; face++) {
        for (int j = 0; j < edge; j++) {
            for (int i = 0; i < edge; i++) {
                double d[3];
                texel_direction(face, (2.0 * i + 1) / edge - 1, (2.0 * j + 1) / edge - 1, d);
                float *texel = glint_cube_texel(cube, face, i, j);
                for (int k = 0; k < 3; k++) {
                    texel[k] = (float)(0.5 + 0.5 * d[k]);
                }
            }
        }
    }
    glint_cube_fill_border(cube);
}
