// Tests heat maps: the colours, and the place of the scale.
#include "image/color.h"
#include "image/image_io.h"
#include "report/compare/heat_map.h"
#include "report/compare/heat_scale.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { WIDTH = 8, HEIGHT = 4, PIXELS = WIDTH * HEIGHT };

// Every component is 1, so that absolute and relative differences are equal.
static glint_image make_image(int width, int height, int channels)
{
    glint_image image = {0};
    assert_int_equal(glint_image_create(width, height, channels, &image, NULL), GLINT_OK);
    for (int i = 0; i < width * height * channels; i++) {
        image.pixels[i] = 1;
    }
    return image;
}

static glint_image paint(const glint_image *image, const glint_image *reference, glint_heat heat)
{
    glint_image map;
    assert_int_equal(glint_heat_map_paint(image, reference, heat, &map, NULL), GLINT_OK);
    return map;
}

static bool has_color(const glint_image *map, int x, int y, const float color[3])
{
    const float *pixel = glint_image_pixel(map, x, y);
    return pixel[0] == color[0] && pixel[1] == color[1] && pixel[2] == color[2];
}

// CIE 1931 luminance of linear Rec.709.
static double luminance(const float rgb[3])
{
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

// CIE 1976 lightness.
static double lightness(const float rgb[3])
{
    double y = luminance(rgb);
    return y > 216.0 / 24389 ? 116 * cbrt(y) - 16 : y * 24389 / 27;
}

static void colors_grow_lighter_and_stay_within_what_can_be_shown(void **state)
{
    (void)state;
    double last = lightness(glint_heat_equal);
    assert_true(last == 0);
    double least_step = INFINITY, largest_step = 0;
    for (int i = 0; i <= 64; i++) {
        float color[3];
        glint_heat_color(i / 64.0, color);
        for (int k = 0; k < 3; k++) {
            assert_true(color[k] > 0 && color[k] <= 1);
        }
        double step = lightness(color) - last;
        assert_true(step > 0);
        if (i > 0) {
            least_step = fmin(least_step, step);
            largest_step = fmax(largest_step, step);
        } else {
            assert_true(step > 15); // no difference and a tiny difference look clearly different
        }
        last += step;
    }
    assert_true(largest_step < 3 * least_step);
}

// Converts to hue as in an 8-bit file. Green is at least half of the larger of red and blue.
static void the_color_of_what_is_not_finite_is_none_of_the_scale(void **state)
{
    (void)state;
    assert_int_equal(glint_linear_to_srgb8(glint_heat_not_finite[0]), 255);
    assert_int_equal(glint_linear_to_srgb8(glint_heat_not_finite[1]), 0);
    assert_int_equal(glint_linear_to_srgb8(glint_heat_not_finite[2]), 255);
    for (int i = 0; i <= 64; i++) {
        float color[3];
        glint_heat_color(i / 64.0, color);
        int green = glint_linear_to_srgb8(color[1]);
        int red = glint_linear_to_srgb8(color[0]), blue = glint_linear_to_srgb8(color[2]);
        assert_true(2 * green >= (red > blue ? red : blue) - 16);
    }
}

static void the_scale_is_logarithmic_and_ends_in_its_colors(void **state)
{
    (void)state;
    for (int k = 0; k <= GLINT_HEAT_DECADES; k++) {
        double expected = (double)k / GLINT_HEAT_DECADES;
        assert_true(fabs(glint_heat_place(pow(10, k - GLINT_HEAT_DECADES), 0) - expected) < 1e-12);
        assert_true(fabs(glint_heat_place(pow(10, k - GLINT_HEAT_DECADES + 3), 3) - expected) <
                    1e-12);
    }
    assert_true(glint_heat_place(INFINITY, 0) == 1 && glint_heat_place(1e30, 0) == 1);
    assert_true(glint_heat_place(1e-30, 0) == 0 && glint_heat_place(0x1p-1074, 0) == 0);
}

static void a_pixel_has_the_color_of_its_largest_difference(void **state)
{
    (void)state;
    glint_image reference = make_image(WIDTH, HEIGHT, 3), image = make_image(WIDTH, HEIGHT, 4);
    glint_image_pixel(&image, 1, 0)[2] -= 0.25F;
    glint_image_pixel(&image, 2, 0)[0] += 0x1p-10F;
    glint_image_pixel(&image, 3, 0)[1] = 100;
    glint_image_pixel(&image, 4, 0)[0] = NAN;
    glint_image_pixel(&image, 5, 0)[0] = -INFINITY;
    glint_image_pixel(&image, 6, 0)[3] = 0.5F; // heat maps ignore alpha
    glint_image map = paint(&image, &reference, GLINT_HEAT_RELATIVE);
    const double differences[] = {0.25, 0x1p-10, 99};
    for (int i = 0; i < 3; i++) {
        float color[3];
        glint_heat_color(glint_heat_place(differences[i], 0), color);
        assert_true(has_color(&map, 1 + i, 0, color));
    }
    assert_true(has_color(&map, 4, 0, glint_heat_not_finite));
    assert_true(has_color(&map, 5, 0, glint_heat_not_finite));
    int equal = 0;
    for (int i = 0; i < PIXELS; i++) {
        equal += has_color(&map, i % WIDTH, i / WIDTH, glint_heat_equal);
    }
    assert_int_equal(equal, PIXELS - 5);
    glint_image_free(&map);
    glint_image_free(&image);
    glint_image_free(&reference);
}

// The codes follow from Green's formula by hand. A file of 8 bits must contain them.
static void a_png_holds_the_colors_as_designed(void **state)
{
    (void)state;
    static const int codes[][3] = {{0, 0, 0}, {81, 193, 107}, {254, 249, 244}, {255, 0, 255}};
    const float values[] = {1, 1 + 0x1p-10F, 2, NAN};
    glint_image reference = make_image(WIDTH, HEIGHT, 3), image = make_image(WIDTH, HEIGHT, 3);
    for (int i = 0; i < 4; i++) {
        glint_image_pixel(&image, i, 0)[1] = values[i];
    }
    glint_image map = paint(&image, &reference, GLINT_HEAT_RELATIVE), read;
    assert_int_equal(glint_image_write(scratch_path("map.png"), &map, NULL, NULL), GLINT_OK);
    assert_int_equal(glint_image_read(scratch_path("map.png"), &read, NULL, NULL), GLINT_OK);
    assert_true(read.width == map.width && read.height == map.height);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) {
            int code = glint_linear_to_srgb8(glint_image_pixel(&read, i, 0)[k]);
            assert_int_equal(code, codes[i][k]);
        }
    }
    glint_image_free(&read);
    glint_image_free(&map);
    glint_image_free(&image);
    glint_image_free(&reference);
}

// The reference is 100 everywhere, so a difference of 1 is a hundredth. Both scales then give the
// colour of 10⁻², because the absolute scale ends at 100.
static void the_absolute_scale_ends_at_the_references_mean(void **state)
{
    (void)state;
    glint_image reference = make_image(WIDTH, HEIGHT, 1), image = make_image(WIDTH, HEIGHT, 1);
    for (int i = 0; i < PIXELS; i++) {
        reference.pixels[i] = 100;
        image.pixels[i] = 101;
    }
    float color[3];
    glint_heat_color(glint_heat_place(0.01, 0), color);
    const glint_heat heats[] = {GLINT_HEAT_RELATIVE, GLINT_HEAT_ABSOLUTE};
    for (int i = 0; i < 2; i++) {
        glint_image map = paint(&image, &reference, heats[i]);
        for (int k = 0; k < 3; k++) {
            assert_true(fabs((double)(glint_image_pixel(&map, 2, 2)[k] - color[k])) < 1e-6);
        }
        glint_image_free(&map);
    }
    glint_image_free(&image);
    glint_image_free(&reference);
}

static void the_scale_fits_below_any_picture(void **state)
{
    (void)state;
    const int sizes[][2] = {{1, 1},      {8, 4},       {311, 9},  {312, 9},   {640, 360}, {1279, 1},
                            {1280, 720}, {1920, 1080}, {4097, 3}, {65536, 1}, {1, 65536}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const int width = sizes[i][0], height = sizes[i][1];
        const glint_heat_layout at = glint_heat_layout_for(width, height);
        assert_true(at.width >= width && at.strip_y == height && at.height > height);
        assert_true(at.width == width || width < 312);
        assert_true(at.unit >= 1 && at.unit * 640 <= (width > 640 ? width : 640));
        // From left to right: the box of equal pixels, the bar, the box of non-finite pixels.
        assert_true(at.equal_x > 0 && at.equal_x + at.bar_height < at.bar_x);
        assert_true(at.bar_x + at.bar_width < at.not_finite_x);
        assert_true(at.not_finite_x + at.bar_height < at.width);
        assert_true(at.bar_y > height && at.bar_y + at.bar_height < at.height);
        // A label of five characters under each decade.
        assert_true(at.bar_width >= GLINT_HEAT_DECADES * 5 * 6 * at.unit);
    }
}

static void the_scale_shows_the_colors_that_the_map_uses(void **state)
{
    (void)state;
    glint_image reference = make_image(640, 20, 3), image = make_image(640, 20, 3);
    glint_image_pixel(&image, 50, 10)[0] += 0.5F;
    glint_image map = paint(&image, &reference, GLINT_HEAT_RELATIVE);
    const glint_heat_layout at = glint_heat_layout_for(640, 20);
    assert_true(map.width == at.width && map.height == at.height && map.channels == 3);
    const int middle = at.bar_y + at.bar_height / 2;
    for (int x = 0; x < at.bar_width; x++) {
        float color[3];
        glint_heat_color((x + 0.5) / at.bar_width, color);
        assert_true(has_color(&map, at.bar_x + x, middle, color));
    }
    assert_true(has_color(&map, at.equal_x + at.bar_height / 2, middle, glint_heat_equal));
    assert_true(
        has_color(&map, at.not_finite_x + at.bar_height / 2, middle, glint_heat_not_finite));
    // The tip of the marker is on the bar at the worst value, and a tick is under every decade.
    const int worst = at.bar_x + (int)lround(glint_heat_place(0.5, 0) * at.bar_width);
    const float *background = glint_image_pixel(&map, 0, at.strip_y);
    assert_false(has_color(&map, worst, at.bar_y - 1, background));
    assert_true(has_color(&map, worst - 2, at.bar_y - 1, background));
    assert_true(has_color(&map, worst + 2, at.bar_y - 1, background));
    for (int k = 0; k <= GLINT_HEAT_DECADES; k++) {
        const int x = at.bar_x + k * at.bar_width / GLINT_HEAT_DECADES;
        assert_false(has_color(&map, x, at.bar_y + at.bar_height, background));
        assert_true(has_color(&map, x + 2, at.bar_y + at.bar_height, background));
    }
    glint_image_free(&map);
    glint_image_free(&image);
    glint_image_free(&reference);
}

static void maps_of_equal_and_of_unusable_pictures_are_whole(void **state)
{
    (void)state;
    glint_image reference = make_image(WIDTH, HEIGHT, 3), image = make_image(WIDTH, HEIGHT, 3);
    glint_image map = paint(&image, &reference, GLINT_HEAT_ABSOLUTE);
    assert_true(has_color(&map, 0, 0, glint_heat_equal));
    glint_image_free(&map);
    for (int i = 0; i < 3 * PIXELS; i++) {
        image.pixels[i] = NAN;
    }
    map = paint(&image, &reference, GLINT_HEAT_ABSOLUTE);
    assert_true(has_color(&map, WIDTH - 1, HEIGHT - 1, glint_heat_not_finite));
    glint_image_free(&map);
    glint_image_free(&image);
    glint_image_free(&reference);
}

static void differences_are_signed_and_per_component(void **state)
{
    (void)state;
    glint_image reference = make_image(WIDTH, HEIGHT, 3), image = make_image(WIDTH, HEIGHT, 3);
    for (int i = 0; i < 3 * PIXELS; i++) {
        reference.pixels[i] = 2;
        image.pixels[i] = 2;
    }
    glint_image_pixel(&image, 1, 1)[0] = 1;
    glint_image_pixel(&image, 1, 1)[2] = 2.5F;
    glint_image_pixel(&image, 2, 1)[1] = INFINITY;
    const float absolute[3] = {-1, 0, 0.5F}, relative[3] = {-0.5F, 0, 0.25F}, zero[3] = {0};
    glint_image map;
    assert_int_equal(
        glint_heat_map_differences(&image, &reference, GLINT_HEAT_ABSOLUTE, &map, NULL), GLINT_OK);
    assert_true(map.width == WIDTH && map.height == HEIGHT && map.channels == 3);
    assert_true(has_color(&map, 1, 1, absolute) && has_color(&map, 0, 0, zero));
    assert_true(isnan(glint_image_pixel(&map, 2, 1)[0]) && isnan(glint_image_pixel(&map, 2, 1)[1]));
    glint_image_free(&map);
    assert_int_equal(
        glint_heat_map_differences(&image, &reference, GLINT_HEAT_RELATIVE, &map, NULL), GLINT_OK);
    assert_true(has_color(&map, 1, 1, relative));
    glint_image_free(&map);
    glint_image_free(&image);
    glint_image_free(&reference);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colors_grow_lighter_and_stay_within_what_can_be_shown),
        cmocka_unit_test(the_color_of_what_is_not_finite_is_none_of_the_scale),
        cmocka_unit_test(the_scale_is_logarithmic_and_ends_in_its_colors),
        cmocka_unit_test(a_pixel_has_the_color_of_its_largest_difference),
        cmocka_unit_test_setup_teardown(a_png_holds_the_colors_as_designed, scratch_setup,
                                        scratch_teardown),
        cmocka_unit_test(the_absolute_scale_ends_at_the_references_mean),
        cmocka_unit_test(the_scale_fits_below_any_picture),
        cmocka_unit_test(the_scale_shows_the_colors_that_the_map_uses),
        cmocka_unit_test(maps_of_equal_and_of_unusable_pictures_are_whole),
        cmocka_unit_test(differences_are_signed_and_per_component),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
