// Tests grids and lists of an image's pixels: each pixel must equal the pixel of the whole image
// bit for bit, whatever else is rendered.
#include "render/pixel_list.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct grid_case {
    const char *scene;
    int width, height, step, samples_per_axis, kernel_width;
    glint_precision precision;
    glint_filter filter;
} grid_case;

static const grid_case cases[] = {
    {"gallery", 203, 117, 2, 1, 0, GLINT_PRECISION_FLOAT, GLINT_FILTER_BILINEAR},
    {"gallery", 203, 117, 7, 2, 0, GLINT_PRECISION_FLOAT, GLINT_FILTER_BILINEAR},
    {"gallery", 96, 54, 3, 1, 0, GLINT_PRECISION_DOUBLE, GLINT_FILTER_BILINEAR},
    {"mirror_sphere", 640, 360, 13, 1, 0, GLINT_PRECISION_FLOAT, GLINT_FILTER_BILINEAR},
    {"mirror_sphere", 640, 360, 16, 3, 1, GLINT_PRECISION_FLOAT, GLINT_FILTER_BILINEAR},
    {"orthographic", 320, 181, 5, 1, 16, GLINT_PRECISION_FLOAT, GLINT_FILTER_BILINEAR},
    {"orthographic", 320, 181, 5, 2, 0, GLINT_PRECISION_FLOAT, GLINT_FILTER_MIP},
    {"facing_mirrors", 64, 48, 48, 1, 8, GLINT_PRECISION_FLOAT, GLINT_FILTER_BILINEAR},
};

static void assert_same_pixel(const glint_image *a, size_t of_a, const glint_image *b, size_t of_b)
{
    assert_memory_equal(a->pixels + 4 * of_a, b->pixels + 4 * of_b, 4 * sizeof *a->pixels);
}

// The list has no order: first the corners, then multiples of a number that shares no divisor with
// the pixel count, some of them repeated. Its rows do not fill whole tiles.
static void check_list(const glint_scene *scene, const glint_environment *environment,
                       const glint_settings *whole_settings, const glint_image *whole)
{
    enum { ROWS = 21, COUNT = ROWS * GLINT_LIST_COLUMNS };
    const uint32_t width = (uint32_t)whole->width, all = width * (uint32_t)whole->height;
    uint32_t list[COUNT] = {0, width - 1, all - width, all - 1};
    for (uint32_t i = 4; i < COUNT; i++) {
        list[i] = i / 3 * 7919 % all;
    }
    glint_settings settings = *whole_settings;
    settings.list = list;
    settings.list_rows = ROWS;
    test_frame listed;
    test_render(scene, environment, NULL, &settings, &listed);
    assert_int_equal(listed.image.width, GLINT_LIST_COLUMNS);
    assert_int_equal(listed.image.height, ROWS);
    for (size_t i = 0; i < COUNT; i++) {
        assert_same_pixel(&listed.image, i, whole, list[i]);
    }
    test_frame_free(&listed);
}

static void check_case(const grid_case *c, int depth)
{
    glint_scene scene = {0};
    test_scene_load(c->scene, &scene);
    glint_settings settings = glint_settings_default;
    settings.width = c->width;
    settings.height = c->height;
    settings.samples_per_axis = c->samples_per_axis;
    settings.kernel_width = c->kernel_width;
    settings.precision = c->precision;
    settings.filter = c->filter;
    settings.depth = depth;
    // Render the whole image, then the grid.
    test_frame whole, grid;
    test_render(&scene, test_studio(), NULL, &settings, &whole);
    settings.grid_step = c->step;
    test_render(&scene, test_studio(), NULL, &settings, &grid);
    int size[2];
    glint_settings_pixels(&settings, size);
    assert_int_equal(grid.image.width, size[0]);
    assert_int_equal(grid.image.height, size[1]);
    assert_int_equal(grid.report.rays.primary,
                     size[0] * size[1] * c->samples_per_axis * c->samples_per_axis);
    // The last pixel of a row and of a column is within the image; the next would be outside.
    assert_in_range((size[0] - 1) * c->step + c->step / 2, 0, c->width - 1);
    assert_true(size[0] * c->step + c->step / 2 >= c->width);
    assert_true(size[1] * c->step + c->step / 2 >= c->height);
    // Compare each pixel of the grid with its pixel of the image.
    for (int y = 0; y < size[1]; y++) {
        for (int x = 0; x < size[0]; x++) {
            const size_t row = (size_t)y * (size_t)c->step + (size_t)(c->step / 2);
            const size_t column = (size_t)x * (size_t)c->step + (size_t)(c->step / 2);
            const size_t place = (size_t)y * (size_t)size[0] + (size_t)x;
            assert_same_pixel(&grid.image, place, &whole.image, row * (size_t)c->width + column);
        }
    }
    test_frame_free(&grid);
    settings.grid_step = 0;
    check_list(&scene, test_studio(), &settings, &whole.image);
    test_frame_free(&whole);
    glint_scene_free(&scene);
}

static void its_pixels_are_the_images(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        check_case(&cases[i], 0);
    }
    check_case(&cases[3], 1); // the short way of mirrors
}

static void a_step_beyond_the_image_is_refused(void **state)
{
    (void)state;
    const glint_scene nothing = {0};
    glint_settings settings = glint_settings_default;
    const glint_plan_inputs inputs = {.scene = &nothing,
                                      .device = glint_device_capabilities(test_device()),
                                      .settings = &settings};
    const int steps[] = {-1, settings.height + 1, settings.height, 0, 1};
    for (int i = 0; i < 5; i++) {
        settings.grid_step = steps[i];
        assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                         i < 2 ? GLINT_USAGE : GLINT_OK);
    }
}

// The last pixels of the largest image, with numbers above 2³¹, against a grid of 4 × 4 pixels.
static void a_list_reaches_every_pixel_of_the_largest_image(void **state)
{
    (void)state;
    enum { SIDE = 65536, STEP = SIDE / 4 };
    assert_int_equal(glint_pixel_number(SIDE, SIDE - 1, SIDE - 1), UINT32_MAX);
    glint_settings settings = glint_settings_default;
    settings.width = settings.height = SIDE;
    settings.grid_step = STEP;
    test_frame grid, listed;
    test_render_named("prism", &settings, &grid);
    assert_int_equal(grid.image.width * grid.image.height, GLINT_LIST_COLUMNS);
    uint32_t list[GLINT_LIST_COLUMNS];
    for (int i = 0; i < GLINT_LIST_COLUMNS; i++) {
        list[i] = glint_pixel_number(SIDE, i % 4 * STEP + STEP / 2, i / 4 * STEP + STEP / 2);
    }
    settings.grid_step = 0;
    settings.list = list;
    settings.list_rows = 1;
    test_render_named("prism", &settings, &listed);
    for (size_t i = 0; i < GLINT_LIST_COLUMNS; i++) {
        assert_same_pixel(&listed.image, i, &grid.image, i);
    }
    test_frame_free(&grid);
    test_frame_free(&listed);
}

static void a_list_of_nothing_is_refused(void **state)
{
    (void)state;
    const glint_scene nothing = {0};
    const uint32_t pixels[GLINT_LIST_COLUMNS] = {0};
    glint_settings settings = glint_settings_default;
    const glint_plan_inputs inputs = {.scene = &nothing,
                                      .device = glint_device_capabilities(test_device()),
                                      .settings = &settings};
    settings.list = pixels;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_USAGE);
    settings.list_rows = 1;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_OK);
    settings.grid_step = 2;
    assert_int_equal(glint_settings_check(inputs.settings, inputs.device, inputs.scene, NULL),
                     GLINT_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_pixels_are_the_images),
        cmocka_unit_test(a_step_beyond_the_image_is_refused),
        cmocka_unit_test(a_list_reaches_every_pixel_of_the_largest_image),
        cmocka_unit_test(a_list_of_nothing_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
