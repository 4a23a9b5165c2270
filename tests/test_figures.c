// Tests bounds on error figures: the verdict and the message.
#include "report/compare/figures.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// Ten pixels, one with a visible difference. Every other figure is 0.25.
static glint_metrics make_metrics(void)
{
    return (glint_metrics){.compared = 10,
                           .differing = 1,
                           .mean = 1,
                           .rmse = 0.25,
                           .relative_rmse = 0.25,
                           .mae = 0.25,
                           .psnr = 0.25,
                           .p99 = 0.25,
                           .largest = 0.25,
                           .alpha = 0.25};
}

static glint_bounds one_bound(glint_figure figure, double limit)
{
    glint_bounds bounds = {0};
    bounds.is_set[figure] = true;
    bounds.limit[figure] = limit;
    return bounds;
}

static glint_status verdict(const glint_bounds *bounds, const glint_metrics *metrics,
                            glint_error *error)
{
    *error = (glint_error){0};
    return glint_bounds_check(bounds, metrics, "a.exr", "b.exr", error);
}

static void a_figure_at_its_bound_keeps_it(void **state)
{
    (void)state;
    const glint_metrics metrics = make_metrics();
    glint_error error;
    for (int i = 0; i < GLINT_FIGURE_COUNT; i++) {
        const glint_figure figure = (glint_figure)i;
        const double value = glint_figure_value(figure, &metrics);
        const double worse = glint_figure_is_better_high(figure) ? 1 : -1;
        glint_bounds bounds = one_bound(figure, value);
        assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_OK);
        bounds = one_bound(figure, value - worse);
        assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_OK);
        bounds = one_bound(figure, nextafter(value, worse * INFINITY));
        assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
        assert_non_null(strstr(error.message, glint_figure_names[i]));
    }
}

static void what_is_not_a_number_keeps_no_bound(void **state)
{
    (void)state;
    glint_metrics metrics = make_metrics();
    glint_error error;
    metrics.rmse = NAN;
    metrics.psnr = NAN;
    metrics.relative_rmse = INFINITY;
    glint_bounds bounds = one_bound(GLINT_FIGURE_RMSE, 1e300);
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
    bounds = one_bound(GLINT_FIGURE_PSNR, 0);
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
    bounds = one_bound(GLINT_FIGURE_RELATIVE_RMSE, 1e300);
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
    metrics.psnr = INFINITY; // equal pictures
    bounds = one_bound(GLINT_FIGURE_PSNR, 1e300);
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_OK);
}

static void nothing_compared_breaks_every_bound(void **state)
{
    (void)state;
    const glint_metrics metrics = {.nonfinite = 10, .in_either = {.nan = 10}};
    const glint_bounds none = {0};
    glint_error error;
    for (int i = 0; i < GLINT_FIGURE_COUNT; i++) {
        const glint_bounds bounds =
            one_bound((glint_figure)i, glint_figure_is_better_high((glint_figure)i) ? 0 : 1e300);
        assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
        assert_non_null(strstr(error.message, "no pixel is finite"));
    }
    assert_int_equal(verdict(&none, &metrics, &error), GLINT_OK);
}

static void any_bound_asks_for_finite_pixels(void **state)
{
    (void)state;
    glint_metrics metrics = make_metrics();
    metrics.in_either = (glint_defects){.nan = 2, .infinite = 1};
    glint_error error;
    glint_bounds bounds = {0};
    glint_bounds_complete(&bounds);
    assert_false(glint_bounds_any(&bounds));
    bounds = one_bound(GLINT_FIGURE_RMSE, 1);
    glint_bounds_complete(&bounds);
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
    assert_string_equal(error.message, "a.exr: nan 2 is above 0, infinite 1 is above 0 (b.exr)");
    bounds = one_bound(GLINT_FIGURE_NAN, 2);
    glint_bounds_complete(&bounds);
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
    assert_string_equal(error.message, "a.exr: infinite 1 is above 0 (b.exr)");
    metrics.in_either.infinite = 0;
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_OK);
}

static void the_message_names_every_broken_bound_with_digits_that_differ(void **state)
{
    (void)state;
    glint_metrics metrics = make_metrics();
    metrics.mae = nextafter(0.25, 1);
    glint_error error;
    glint_bounds bounds = one_bound(GLINT_FIGURE_MAE, 0.25);
    bounds.is_set[GLINT_FIGURE_PSNR] = true;
    bounds.limit[GLINT_FIGURE_PSNR] = 40;
    assert_int_equal(verdict(&bounds, &metrics, &error), GLINT_MISMATCH);
    assert_string_equal(
        error.message,
        "a.exr: mae 0.25000000000000006 is above 0.25, psnr 0.25 is below 40 (b.exr)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_figure_at_its_bound_keeps_it),
        cmocka_unit_test(what_is_not_a_number_keeps_no_bound),
        cmocka_unit_test(nothing_compared_breaks_every_bound),
        cmocka_unit_test(any_bound_asks_for_finite_pixels),
        cmocka_unit_test(the_message_names_every_broken_bound_with_digits_that_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
