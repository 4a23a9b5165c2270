// Tests the error figures of pictures.
#include "image/metrics.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 20, HEIGHT = 10, PIXELS = WIDTH * HEIGHT };

// Every pixel is (1, 2, 3) with alpha 1: the mean is 2.
static glint_image make_image(void)
{
    glint_image image = {0};
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, 4, &image, NULL), GLINT_OK);
    for (int i = 0; i < PIXELS; i++) {
        const float pixel[4] = {1, 2, 3, 1};
        memcpy(image.pixels + 4 * i, pixel, sizeof pixel);
    }
    return image;
}

static glint_metrics find(const glint_image *image, const glint_image *reference,
                          const bool *left_out)
{
    glint_metrics metrics;
    assert_int_equal(glint_metrics_find(image, reference, left_out, &metrics, NULL), GLINT_OK);
    return metrics;
}

static void a_picture_has_no_error_against_itself(void **state)
{
    (void)state;
    glint_image image = make_image();
    glint_metrics m = find(&image, &image, NULL);
    assert_int_equal(m.compared, PIXELS);
    assert_int_equal(m.nonfinite + m.differing, 0);
    assert_true(m.rmse == 0 && m.relative_rmse == 0 && m.p99 == 0 && m.largest == 0);
    assert_true(m.mean == 2);
    glint_image_free(&image);
}

static void one_pixel_off_gives_the_known_figures(void **state)
{
    (void)state;
    glint_image reference = make_image(), image = make_image();
    glint_image_pixel(&image, 3, 4)[1] += 0.5F;
    glint_image_pixel(&image, 5, 4)[3] = 0.25F; // alpha has its own figure
    glint_metrics m = find(&image, &reference, NULL);
    assert_true(fabs(m.rmse - sqrt(0.25 / (3 * PIXELS))) < 1e-15);
    assert_true(fabs(m.relative_rmse - m.rmse / 2) < 1e-15);
    assert_true(fabs(m.mae - 0.5 / (3 * PIXELS)) < 1e-15);
    assert_true(m.largest == 0.5 && m.p99 == 0); // one of 200 is within the hundredth
    assert_int_equal(m.differing, 1);
    assert_true(m.worst_x == 3 && m.worst_y == 4);
    assert_true(m.worst_image[1] == 2.5F && m.worst_reference[1] == 2);
    assert_true(m.alpha == 0.75);
    glint_image_free(&reference);
    glint_image_free(&image);
}

// Sums of powers of two have no rounding.
static void a_constant_offset_is_every_figure(void **state)
{
    (void)state;
    const float offsets[] = {0.25F, -0.25F, 16, 0x1p-20F};
    for (size_t k = 0; k < sizeof offsets / sizeof *offsets; k++) {
        glint_image reference = make_image(), image = make_image();
        for (int i = 0; i < 4 * PIXELS; i++) {
            image.pixels[i] += i % 4 < 3 ? offsets[k] : 0;
        }
        double size = fabs((double)offsets[k]);
        glint_metrics m = find(&image, &reference, NULL);
        assert_true(m.rmse == size && m.mae == size && m.p99 == size && m.largest == size);
        assert_true(m.relative_rmse == size / 2);
        assert_true(fabs(m.psnr + 20 * log10(size)) < 1e-12);
        assert_true(m.worst_x == 0 && m.worst_y == 0 && m.alpha == 0);
        glint_image_free(&reference);
        glint_image_free(&image);
    }
}

static void visible_is_a_hundredth_of_the_pixel_or_of_the_mean(void **state)
{
    (void)state;
    glint_image reference = make_image(), image = make_image();
    glint_image_pixel(&image, 0, 0)[0] += 0.019F; // under 1% of the mean, 2
    glint_image_pixel(&image, 1, 0)[0] += 0.021F;
    glint_image_pixel(&image, 2, 0)[2] += 0.029F; // under 1% of 3
    glint_image_pixel(&image, 3, 0)[2] -= 0.031F;
    assert_int_equal(find(&image, &reference, NULL).differing, 2);
    bool marks[PIXELS];
    assert_int_equal(glint_metrics_mark(&image, &reference, GLINT_METRICS_VISIBLE, marks), 2);
    assert_true(!marks[0] && marks[1] && !marks[2] && marks[3]);
    assert_int_equal(glint_metrics_mark(&image, &reference, GLINT_METRICS_VISIBLE / 10, marks), 4);
    glint_image_free(&reference);
    glint_image_free(&image);
}

static void pixels_that_are_left_out_do_not_count(void **state)
{
    (void)state;
    glint_image reference = make_image(), image = make_image();
    glint_image_pixel(&image, 0, 0)[0] = 100;
    bool left_out[PIXELS] = {true};
    glint_metrics m = find(&image, &reference, left_out);
    assert_int_equal(m.compared, PIXELS - 1);
    assert_true(m.largest == 0 && m.differing == 0 && m.mean == 2);
    memset(left_out, true, sizeof left_out);
    m = find(&image, &reference, left_out);
    assert_true(m.compared == 0 && m.relative_rmse == 0);
    assert_true(m.rmse == 0 && m.mae == 0 && m.psnr == 0 && m.p99 == 0 && m.largest == 0);
    glint_image_free(&reference);
    glint_image_free(&image);
}

static void what_is_not_finite_is_counted_and_spreads_no_further(void **state)
{
    (void)state;
    glint_image reference = make_image(), image = make_image();
    glint_image_pixel(&image, 0, 0)[0] = NAN;
    glint_image_pixel(&image, 1, 0)[2] = INFINITY;
    glint_image_pixel(&reference, 2, 0)[1] = NAN;
    glint_metrics m = find(&image, &reference, NULL);
    assert_int_equal(m.nonfinite, 3);
    assert_int_equal(m.compared, PIXELS - 3);
    assert_true(m.in_image.nan == 1 && m.in_image.infinite == 1);
    assert_true(m.in_reference.nan == 1 && m.in_reference.infinite == 0);
    assert_true(m.in_either.nan == 2 && m.in_either.infinite == 1);
    assert_true(m.rmse == 0 && m.mean == 2);
    bool marks[PIXELS];
    assert_int_equal(glint_metrics_mark(&image, &reference, 1, marks), 3);
    glint_image_free(&reference);
    glint_image_free(&image);
}

static void a_pixel_that_is_not_finite_on_both_sides_counts_once(void **state)
{
    (void)state;
    glint_image reference = make_image(), image = make_image();
    glint_image_pixel(&image, 7, 1)[0] = NAN;
    glint_image_pixel(&image, 7, 1)[1] = -INFINITY;
    glint_image_pixel(&reference, 7, 1)[0] = NAN;
    glint_image_pixel(&image, 8, 1)[3] = NAN; // alpha does not hide the colour
    glint_metrics m = find(&image, &reference, NULL);
    assert_true(m.nonfinite == 1 && m.compared == PIXELS - 1);
    assert_true(m.in_either.nan == 2 && m.in_either.infinite == 1);
    assert_true(m.in_image.nan == 2 && m.in_reference.nan == 1);
    assert_true(m.alpha == 0 && m.largest == 0);
    for (int i = 0; i < PIXELS; i++) {
        image.pixels[4 * i] = NAN;
    }
    m = find(&image, &reference, NULL);
    assert_true(m.compared == 0 && m.nonfinite == PIXELS && m.mean == 0 && m.psnr == 0);
    glint_image_free(&reference);
    glint_image_free(&image);
}

static void equal_values_have_no_error_whatever_their_sign_of_zero(void **state)
{
    (void)state;
    glint_image reference = {0}, image = {0};
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, 3, &reference, NULL), GLINT_OK);
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, 3, &image, NULL), GLINT_OK);
    for (int i = 0; i < 3 * PIXELS; i++) {
        image.pixels[i] = -0.0F;
    }
    glint_metrics m = find(&image, &reference, NULL);
    assert_true(m.rmse == 0 && m.relative_rmse == 0 && m.differing == 0);
    assert_true(isinf(m.psnr) && m.psnr > 0);
    image.pixels[0] = 0x1p-149F; // even the smallest float is a difference
    m = find(&image, &reference, NULL);
    assert_true(m.largest == 0x1p-149 && m.rmse > 0 && isinf(m.relative_rmse));
    glint_image_free(&reference);
    glint_image_free(&image);
}

static void a_reference_whose_mean_is_zero_has_an_infinite_relative_error(void **state)
{
    (void)state;
    glint_image reference = {0}, image = {0};
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, 3, &reference, NULL), GLINT_OK);
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, 3, &image, NULL), GLINT_OK);
    reference.pixels[0] = 1;
    reference.pixels[1] = -1;
    glint_metrics m = find(&image, &reference, NULL);
    assert_true(m.mean == 0 && isinf(m.relative_rmse) && isfinite(m.rmse));
    assert_int_equal(m.differing, 1);
    glint_image_free(&reference);
    glint_image_free(&image);
}

static glint_image make_flat(int channels, const float *pixel)
{
    glint_image image = {0};
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, channels, &image, NULL), GLINT_OK);
    for (int i = 0; i < PIXELS; i++) {
        memcpy(image.pixels + channels * i, pixel, (size_t)channels * sizeof *pixel);
    }
    return image;
}

static void grey_is_three_equal_components_and_a_missing_alpha_is_one(void **state)
{
    (void)state;
    const float values[] = {0.5F, 0.5F, 0.5F, 1};
    const float grey_and_alpha[] = {0.5F, 0.75F};
    glint_image grey = make_flat(1, values), color = make_flat(4, values);
    glint_image translucent = make_flat(2, grey_and_alpha), opaque = make_flat(3, values);
    const glint_image *const equal[] = {&grey, &color, &opaque};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            glint_metrics m = find(equal[i], equal[k], NULL);
            assert_true(m.largest == 0 && m.alpha == 0 && m.mean == 0.5 && m.compared == PIXELS);
        }
        assert_true(find(equal[i], &translucent, NULL).alpha == 0.25);
        assert_true(find(&translucent, equal[i], NULL).largest == 0);
    }
    glint_image_free(&grey);
    glint_image_free(&color);
    glint_image_free(&translucent);
    glint_image_free(&opaque);
}

static void a_black_reference_has_an_infinite_relative_error(void **state)
{
    (void)state;
    glint_image reference = {0}, image = {0};
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, 4, &reference, NULL), GLINT_OK);
    assert_int_equal(glint_image_create(WIDTH, HEIGHT, 4, &image, NULL), GLINT_OK);
    assert_true(find(&image, &reference, NULL).relative_rmse == 0);
    image.pixels[0] = 1e-3F;
    glint_metrics m = find(&image, &reference, NULL);
    assert_true(isinf(m.relative_rmse) && m.differing == 1);
    glint_image_free(&reference);
    glint_image_free(&image);
}

static void pictures_of_other_shapes_are_refused(void **state)
{
    (void)state;
    glint_image reference = make_image(), image = {0};
    glint_metrics metrics;
    assert_int_equal(glint_image_create(WIDTH, HEIGHT + 1, 4, &image, NULL), GLINT_OK);
    assert_int_equal(glint_metrics_find(&image, &reference, NULL, &metrics, NULL), GLINT_USAGE);
    glint_image_free(&image);
    assert_int_equal(glint_image_create(WIDTH - 1, HEIGHT, 4, &image, NULL), GLINT_OK);
    assert_int_equal(glint_metrics_find(&image, &reference, NULL, &metrics, NULL), GLINT_USAGE);
    glint_image_free(&image);
    glint_image_free(&reference);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_has_no_error_against_itself),
        cmocka_unit_test(one_pixel_off_gives_the_known_figures),
        cmocka_unit_test(a_constant_offset_is_every_figure),
        cmocka_unit_test(visible_is_a_hundredth_of_the_pixel_or_of_the_mean),
        cmocka_unit_test(pixels_that_are_left_out_do_not_count),
        cmocka_unit_test(what_is_not_finite_is_counted_and_spreads_no_further),
        cmocka_unit_test(a_pixel_that_is_not_finite_on_both_sides_counts_once),
        cmocka_unit_test(equal_values_have_no_error_whatever_their_sign_of_zero),
        cmocka_unit_test(a_reference_whose_mean_is_zero_has_an_infinite_relative_error),
        cmocka_unit_test(grey_is_three_equal_components_and_a_missing_alpha_is_one),
        cmocka_unit_test(a_black_reference_has_an_infinite_relative_error),
        cmocka_unit_test(pictures_of_other_shapes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
