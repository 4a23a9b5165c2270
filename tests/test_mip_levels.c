// Properties of an environment's coarser levels.
#include "base/half.h"
#include "environment/mip_levels.h"
#include "support/direction_maps.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static void every_level_has_half_of_the_edge(void **state)
{
    (void)state;
    static const int counts[][2] = {{0, 0}, {1, 1}, {2, 2}, {3, 2}, {4, 3}, {7, 3}, {512, 10}};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        assert_int_equal(glint_mip_level_count(counts[i][0]), counts[i][1]);
    }
    assert_int_equal(glint_mip_levels_size(5), 6 * 4 * (7 * 7 + 4 * 4 + 3 * 3));
}

// All levels of a map of one edge, one after the other; the caller frees them.
static float *levels_of(const glint_cube *cube)
{
    float *levels = calloc(glint_mip_levels_size(cube->edge), sizeof *levels);
    assert_non_null(levels);
    glint_mip_levels_fill(cube, levels);
    return levels;
}

// The border of a uniform map is its value to a rounding or two, level by level.
static void a_uniform_map_is_uniform_at_every_level(void **state)
{
    (void)state;
    for (int edge = 1; edge < 40; edge += 3) {
        glint_cube cube;
        assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
        for (size_t i = 0; i < glint_cube_size(&cube); i++) {
            cube.texels[i] = 0.7f;
        }
        float *levels = levels_of(&cube);
        for (size_t i = 0; i < glint_mip_levels_size(edge); i++) {
            assert_true(fabs((double)levels[i] - 0.7) < 1e-6);
        }
        free(levels);
        glint_cube_free(&cube);
    }
}

// The solid angle of the rectangle from the corner (0, 0) to (s, t) at the distance 1.
static double corner_angle(double s, double t)
{
    return atan2(s * t, sqrt(1 + s * s + t * t));
}

static double texel_angle(int edge, int i, int j)
{
    const double s0 = 2.0 * i / edge - 1, s1 = 2.0 * (i + 1) / edge - 1;
    const double t0 = 2.0 * j / edge - 1, t1 = 2.0 * (j + 1) / edge - 1;
    return corner_angle(s1, t1) - corner_angle(s0, t1) - corner_angle(s1, t0) +
           corner_angle(s0, t0);
}

static double light_of(const glint_cube *cube)
{
    double sum = 0;
    for (int face = 0; face < 6; face++) {
        for (int k = 0; k < cube->edge * cube->edge; k++) {
            const int i = k % cube->edge, j = k / cube->edge;
            sum += texel_angle(cube->edge, i, j) * (double)*glint_cube_texel(cube, face, i, j);
        }
    }
    return sum;
}

// One bright texel anywhere. A texel of a level with an odd edge is divided between two of the
// next, as if all of it were seen under the same angle: the parts of one of 1/n of the edge differ
// by about 3/n of their mean, and by half of that from it.
static void every_level_sends_the_same_light(void **state)
{
    (void)state;
    static const int edges[] = {2, 3, 5, 16, 31, 64};
    for (int trial = 0; trial < 60; trial++) {
        const int edge = edges[trial % 6];
        glint_cube cube;
        assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
        const int face = trial % 5, i = (trial * 7) % edge, j = (trial * 13) % edge;
        *glint_cube_texel(&cube, face, i, j) = 1000;
        glint_cube_fill_border(&cube);
        const double light = light_of(&cube);
        float *levels = levels_of(&cube);
        glint_cube level = {edge, levels};
        double bound = 0;
        while (level.edge > 1) {
            bound += level.edge % 2 == 0 ? 1e-6 : 1.5 / level.edge;
            level = (glint_cube){level.edge / 2, level.texels + glint_cube_size(&level)};
            assert_true(fabs(light_of(&level) / light - 1) < bound);
        }
        free(levels);
        glint_cube_free(&cube);
    }
}

// A map of directions stays one: a level's colour along d is d's, as it is of a map of its edge.
// The mean over a texel is off its centre by no more than the interpolation is.
static void levels_lie_in_place(void **state)
{
    (void)state;
    glint_cube cube;
    const int edge = 48;
    assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
    for (int k = 0; k < 6 * edge * edge; k++) {
        const int face = k / (edge * edge), i = k % edge, j = k / edge % edge;
        double rgb[3];
        color_of(glint_cube_direction(face, (2.0 * i + 1) / edge - 1, (2.0 * j + 1) / edge - 1),
                 rgb);
        for (int c = 0; c < 3; c++) {
            glint_cube_texel(&cube, face, i, j)[c] = (float)rgb[c];
        }
    }
    glint_cube_fill_border(&cube);
    float *levels = levels_of(&cube);
    glint_cube level = {edge, levels};
    while (level.edge > 3) {
        level = (glint_cube){level.edge / 2, level.texels + glint_cube_size(&level)};
        assert_true(worst_error(&level) <= 2 * seam_bound(level.edge));
    }
    free(levels);
    glint_cube_free(&cube);
}

static void halfs_are_the_rounded_levels(void **state)
{
    (void)state;
    glint_cube cube;
    assert_int_equal(glint_cube_create(9, &cube, NULL), GLINT_OK);
    for (size_t i = 0; i < glint_cube_size(&cube); i++) {
        cube.texels[i] = (float)(next_random() + 1);
    }
    float *levels = levels_of(&cube);
    const size_t size = glint_mip_levels_size(9);
    uint16_t *halfs = calloc(size, sizeof *halfs);
    assert_non_null(halfs);
    glint_mip_levels_to_half(9, levels, halfs);
    for (size_t i = 0; i < size; i++) {
        assert_int_equal(halfs[i], glint_half_from_float(levels[i]));
    }
    free(halfs);
    free(levels);
    glint_cube_free(&cube);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_level_has_half_of_the_edge),
        cmocka_unit_test(a_uniform_map_is_uniform_at_every_level),
        cmocka_unit_test(every_level_sends_the_same_light),
        cmocka_unit_test(levels_lie_in_place),
        cmocka_unit_test(halfs_are_the_rounded_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
