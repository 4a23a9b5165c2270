// Tests the coarser levels of an environment.
#include "base/half.h"
#include "environment/mip_levels.h"
#include "support/direction_maps.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void every_level_has_half_of_the_edge(void **state)
{
    (void)state;
    assert_int_equal(glint_mip_levels_size(0), 0);
    assert_int_equal(glint_mip_levels_size(1), 6 * 4 * 9);
    assert_int_equal(glint_mip_levels_size(5), 6 * 4 * (7 * 7 + 4 * 4 + 3 * 3));
}

// Makes all levels of a map, one after the other. The caller frees them.
static float *levels_of(const glint_cube *cube)
{
    float *levels = calloc(glint_mip_levels_size(cube->edge), sizeof *levels);
    assert_non_null(levels);
    memcpy(levels, cube->texels, glint_cube_size(cube) * sizeof *levels);
    glint_mip_levels_fill(cube, levels + glint_cube_size(cube));
    return levels;
}

// The border of a uniform map equals its value to a rounding or two, at every level.
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

// The solid angle of a texel by the plain sum of (1 + s² + t²)^(−3/2) over 32² parts: within 10⁻³
// of the exact value.
static double texel_angle(int edge, int i, int j)
{
    const int parts = 32;
    double sum = 0;
    for (int k = 0; k < parts * parts; k++) {
        const int column = k % parts, row = k / parts;
        const double s = 2 * (i + (column + 0.5) / parts) / edge - 1;
        const double t = 2 * (j + (row + 0.5) / parts) / edge - 1;
        sum += pow(1 + s * s + t * t, -1.5);
    }
    return sum * 4 / ((double)edge * edge * parts * parts);
}

static double light_of(const glint_cube *cube)
{
    double sum = 0;
    for (int face = 0; face < 6; face++) {
        for (int k = 0; k < cube->edge * cube->edge; k++) {
            const int i = k % cube->edge, j = k / cube->edge;
            const double texel = (double)*glint_cube_texel(cube, face, i, j);
            sum += texel > 0 ? texel * texel_angle(cube->edge, i, j) : 0;
        }
    }
    return sum;
}

// One bright texel anywhere. A level with an odd edge divides a texel between two texels of the
// next level, as if all of it had the same solid angle per area. The parts of a texel of 1/n of the
// edge differ by about 3/n of their mean, so each differs from the mean by half of this.
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
        glint_cube level = {.edge = edge, .texels = levels};
        double bound = 0;
        while (level.edge > 1) {
            bound += level.edge % 2 == 0 ? 2e-3 : 1.5 / level.edge;
            level = (glint_cube){.edge = level.edge / 2,
                                 .texels = level.texels + glint_cube_size(&level)};
            assert_true(fabs(light_of(&level) / light - 1) < bound);
        }
        free(levels);
        glint_cube_free(&cube);
    }
}

// The levels of a map of directions are maps of directions: the colour along d is that of d, as in
// a map of this edge. The mean over a texel errs by no more than interpolation does. At an odd edge
// texels shift by the difference of their parts, 1.5/n of their width of 2/n.
static void levels_lie_in_place(void **state)
{
    (void)state;
    static const int edges[] = {48, 45, 31};
    for (size_t e = 0; e < 3; e++) {
        glint_cube cube;
        const int edge = edges[e];
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
        glint_cube level = {.edge = edge, .texels = levels};
        double shift = 0;
        while (level.edge > 3) {
            shift += level.edge % 2 == 0 ? 0 : 3.0 / (level.edge * level.edge);
            level = (glint_cube){.edge = level.edge / 2,
                                 .texels = level.texels + glint_cube_size(&level)};
            assert_true(worst_error(&level) <= 2 * seam_bound(level.edge) + shift);
        }
        free(levels);
        glint_cube_free(&cube);
    }
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
    glint_mip_levels_to_half(&cube, levels + glint_cube_size(&cube), halfs);
    for (size_t i = 0; i < size; i++) {
        assert_int_equal(halfs[i], glint_half_from_float(levels[i]));
    }
    free(halfs);
    free(levels);
    glint_cube_free(&cube);
}

// A light on the texels around one corner of the cube, nearly as bright as half holds. At the level
// of one texel a face, the border is twice as bright, so it is clamped.
static void borders_that_half_cannot_hold_are_cut(void **state)
{
    (void)state;
    const int edge = 64;
    glint_cube cube;
    assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
    for (int k = 0; k < 6 * edge * edge; k++) {
        const int face = k / (edge * edge), i = k % edge, j = k / edge % edge;
        const glint_vec3 d =
            glint_cube_direction(face, (2.0 * i + 1) / edge - 1, (2.0 * j + 1) / edge - 1);
        *glint_cube_texel(&cube, face, i, j) = fmin(d.x, fmin(d.y, d.z)) > 0.875 ? 60000 : 0;
    }
    glint_cube_fill_border(&cube);
    float *levels = levels_of(&cube);
    const size_t size = glint_mip_levels_size(edge);
    float largest = 0;
    for (size_t i = 0; i < size; i++) {
        largest = fmaxf(largest, levels[i]);
    }
    assert_true(largest > GLINT_HALF_MAX);
    uint16_t *halfs = calloc(size, sizeof *halfs);
    assert_non_null(halfs);
    glint_mip_levels_to_half(&cube, levels + glint_cube_size(&cube), halfs);
    for (size_t i = 0; i < size; i++) {
        assert_true(fabsf(glint_half_to_float(halfs[i])) <= GLINT_HALF_MAX);
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
        cmocka_unit_test(borders_that_half_cannot_hold_are_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
