// Tests half texels: the measured errors are the errors of rounding, and the stored texels are the
// rounded map.
#include "base/half.h"
#include "environment/half_texels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static glint_cube uniform_cube(int edge, float value)
{
    glint_cube cube;
    assert_int_equal(glint_cube_create(edge, &cube, NULL), GLINT_OK);
    for (size_t i = 0; i < glint_cube_size(&cube); i++) {
        cube.texels[i] = i % 4 == 3 ? 1.0f : value;
    }
    return cube;
}

static glint_half_rounding measure_and_free(glint_cube *cube)
{
    glint_half_rounding rounding;
    assert_int_equal(glint_half_rounding_measure(cube, &rounding, NULL), GLINT_OK);
    glint_cube_free(cube);
    return rounding;
}

static void what_half_can_hold_has_no_error(void **state)
{
    (void)state;
    static const float values[] = {0, 1, 0.333251953125f, 0x1p-24f, GLINT_HALF_MAX};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        glint_cube cube = uniform_cube(5, values[i]);
        glint_half_rounding rounding = measure_and_free(&cube);
        assert_true(rounding.relative_rmse == 0 && rounding.visible_rmse == 0);
        assert_true(rounding.largest == values[i]);
    }
    glint_half_rounding nothing = measure_and_free(&(glint_cube){0});
    assert_true(nothing.relative_rmse == 0 && nothing.visible_rmse == 0 && nothing.largest == 0);
}

// 1 + 2⁻¹¹ is a tie and becomes 1. 3 × 2⁻²⁶ becomes 2⁻²⁴, a third more.
static void a_uniform_map_errs_by_its_own_rounding(void **state)
{
    (void)state;
    static const double values[][2] = {{1 + 0x1p-11, 1}, {3 * 0x1p-26, 0x1p-24}};
    for (size_t i = 0; i < 2; i++) {
        double expected = fabs(values[i][1] - values[i][0]) / values[i][0];
        glint_cube cube = uniform_cube(100, (float)values[i][0]);
        glint_half_rounding rounding = measure_and_free(&cube);
        // The mean is rounded to float; the errors are not.
        assert_true(fabs(rounding.relative_rmse - expected) <= 0x1p-23 * expected);
        assert_true(fabs(rounding.visible_rmse - expected) <= 0x1p-23 * expected);
    }
}

// One texel of 2048.9 in a map of 1s, edge 3. The middle of a face has the solid angle 4 asin(1/10)
// of 4π, and its texel errs by 0.9.
static void a_light_counts_by_its_solid_angle(void **state)
{
    (void)state;
    const double share = 4 * asin(0.1) / (4 * GLINT_PI);
    const double light = (double)2048.9f, error = light - 2048;
    glint_cube cube = uniform_cube(3, 1);
    for (int c = 0; c < 3; c++) {
        glint_cube_texel(&cube, 3, 1, 1)[c] = 2048.9f;
    }
    double mean = 1 + share * (light - 1);
    glint_half_rounding rounding = measure_and_free(&cube);
    double relative = sqrt(share) * error / mean, visible = sqrt(share) * error / light;
    // glint computes solid angles from the centres of texels. At edge 3 this is 8% too much.
    assert_true(fabs(rounding.relative_rmse / relative - 1) < 0.05);
    assert_true(fabs(rounding.visible_rmse / visible - 1) < 0.05);
    assert_true(rounding.largest == 2048.9f);
}

static void the_border_too_must_fit(void **state)
{
    (void)state;
    glint_cube cube = uniform_cube(8, 1);
    glint_cube_texel(&cube, 4, -1, 3)[1] = -70000.0f;
    glint_half_rounding rounding = measure_and_free(&cube);
    assert_true(rounding.largest == 70000.0f);
    assert_true(rounding.relative_rmse == 0); // the border covers no solid angle of its own
    cube = uniform_cube(8, 1);
    glint_cube_texel(&cube, 2, 8, 8)[2] = NAN;
    glint_cube_texel(&cube, 5, 0, 0)[0] = INFINITY;
    assert_true(isnan(measure_and_free(&cube).largest));
}

static void every_texel_is_written_in_its_place(void **state)
{
    (void)state;
    glint_cube cube = uniform_cube(7, 1);
    size_t count = glint_cube_size(&cube);
    for (size_t i = 0; i < count; i++) {
        cube.texels[i] = (float)i * (i % 3 == 0 ? -0.01f : 0.37f);
    }
    uint16_t *texels = calloc(count + 1, sizeof *texels);
    assert_non_null(texels);
    glint_cube_to_half(&cube, texels);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(texels[i], glint_half_from_float(cube.texels[i]));
    }
    free(texels);
    glint_cube_free(&cube);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_half_can_hold_has_no_error),
        cmocka_unit_test(a_uniform_map_errs_by_its_own_rounding),
        cmocka_unit_test(a_light_counts_by_its_solid_angle),
        cmocka_unit_test(the_border_too_must_fit),
        cmocka_unit_test(every_texel_is_written_in_its_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
