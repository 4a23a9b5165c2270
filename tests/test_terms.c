// Tests terms of pixels: relighting a frame must give the frame rendered with the new environment.
#include "render/terms.h"

#include "image/image_io.h"
#include "support/bridge.h"
#include "support/render.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Makes another environment: the radiance of the first along a direction, in another colour.
static void other_environment(glint_environment *environment)
{
    bridge_direction_environment(32, environment);
    for (size_t i = 0; i < glint_cube_size(&environment->radiance); i += 4) {
        float *texel = environment->radiance.texels + i;
        const float red = texel[0];
        texel[0] = 2 * texel[1];
        texel[1] = red;
        texel[2] = 3 - 3 * texel[2];
    }
}

static void render(const char *name, const glint_environment *environment,
                   const glint_settings *settings, test_frame *frame)
{
    glint_scene scene;
    test_scene_load(name, &scene);
    test_render(&scene, environment, NULL, settings, frame);
    glint_scene_free(&scene);
}

// Writes the frame's terms to a file and reads them.
static glint_terms terms_of(const test_frame *frame)
{
    glint_terms terms;
    glint_error error = {0};
    const glint_write_options options = {.exr_float = true,
                                         .channels = frame->layers.channels,
                                         .channel_count = frame->layers.count};
    assert_int_equal(glint_image_write(scratch_path("terms.exr"), &frame->image, &options, &error),
                     GLINT_OK);
    assert_int_equal(glint_terms_read(scratch_path("terms.exr"), &terms, &error), GLINT_OK);
    return terms;
}

// A pixel is a sum of up to `capacity` products of numbers up to 3·weight. All weights add up to at
// most 1. The error is at most half a hundred roundings of numbers under 3.
static const double rounding = 50 * 6e-8 * 3;

static double worst_difference(const glint_image *a, const glint_image *b)
{
    double worst = 0;
    assert_true(a->width == b->width && a->height == b->height);
    for (size_t i = 0; i < (size_t)a->width * (size_t)a->height * 4; i++) {
        worst = fmax(worst, fabs((double)a->pixels[i] - (double)b->pixels[i]));
    }
    return worst;
}

static void check(const char *name, const glint_settings *settings)
{
    glint_environment first, other;
    glint_settings plain = *settings;
    test_frame kept, wanted;
    glint_image found = {0};
    glint_error error = {0};
    plain.terms = 0;
    bridge_direction_environment(32, &first);
    other_environment(&other);
    render(name, &first, settings, &kept);
    assert_true(kept.plan.features[GLINT_FEATURE_TERMS].compiled);
    glint_terms terms = terms_of(&kept);
    assert_int_equal(terms.capacity, settings->terms);
    assert_true(terms.dropped == 0);

    // Relight with the same environment.
    assert_int_equal(glint_terms_relight(&terms, &first, settings->env_rotate, &found, &error),
                     GLINT_OK);
    assert_true(worst_difference(&found, &kept.image) <= rounding);
    glint_image_free(&found);

    // Relight with another environment, rotated.
    plain.env_rotate = 70;
    render(name, &other, &plain, &wanted);
    assert_int_equal(glint_terms_relight(&terms, &other, 70, &found, &error), GLINT_OK);
    const double worst = worst_difference(&found, &wanted.image);
    print_message("%s: lit anew, off by %.2g at most\n", name, worst);
    assert_true(worst <= rounding);
    glint_image_free(&found);

    glint_terms_free(&terms);
    test_frame_free(&kept);
    test_frame_free(&wanted);
    glint_environment_free(&first);
    glint_environment_free(&other);
}

static glint_settings keeping(int terms, int depth)
{
    glint_settings settings = test_small_frame(depth);
    settings.terms = terms;
    settings.texels = GLINT_TEXELS_FLOAT;
    return settings;
}

static void a_frame_lit_anew_is_a_frame(void **state)
{
    (void)state;
    static const char *const scenes[] = {"mirror_sphere", "lecture_example_2", "materials",
                                         "glass_sphere",  "absorption_box",    "facing_mirrors",
                                         "lights"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        glint_settings settings = keeping(32, 4);
        check(scenes[i], &settings);
    }
}

static void of_samples_and_of_holes_too(void **state)
{
    (void)state;
    glint_settings settings = keeping(32, 2);
    settings.samples_per_axis = 2;
    settings.env_rotate = 25;
    check("lecture_example_2", &settings);
    settings.transparent = true;
    check("mirror_sphere", &settings);
}

static void packets_of_1_8_and_16_rays_keep_the_same(void **state)
{
    (void)state;
    const int widths[] = {1, 8, 16};
    glint_environment environment;
    test_frame frames[3];
    bridge_direction_environment(32, &environment);
    for (int i = 0; i < 3; i++) {
        glint_settings settings = keeping(4, 6); // fewer than there are
        settings.kernel_width = widths[i];
        render("glass_sphere", &environment, &settings, &frames[i]);
    }
    for (int i = 1; i < 3; i++) {
        assert_int_equal(frames[0].layers.count, frames[i].layers.count);
        for (size_t c = 0; c < frames[0].layers.count; c++) {
            const float *a = frames[0].layers.channels[c].values;
            const float *b = frames[i].layers.channels[c].values;
            for (int p = 0; p < 61 * 43; p++) {
                assert_true(fabs((double)a[p] - (double)b[p]) <= 1e-5);
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        test_frame_free(&frames[i]);
    }
    glint_environment_free(&environment);
}

// The environment is at most 1, so a pixel lacks at most the weight of the dropped terms.
static void what_finds_no_room_is_the_lightest_and_is_counted(void **state)
{
    (void)state;
    glint_environment environment;
    test_frame all, few;
    glint_image found = {0};
    glint_error error = {0};
    glint_settings settings = keeping(32, 8);
    bridge_direction_environment(32, &environment);
    render("glass_sphere", &environment, &settings, &all);
    settings.terms = 2;
    render("glass_sphere", &environment, &settings, &few);
    assert_int_equal(few.layers.count, 4 + 2 * 7);
    glint_terms terms = terms_of(&few);
    assert_true(terms.dropped > 1e-4 && terms.dropped < 0.2);
    assert_int_equal(glint_terms_relight(&terms, &environment, 0, &found, &error), GLINT_OK);
    const float *dropped = few.layers.channels[3].values;
    double most = 0;
    for (size_t p = 0; p < 61 * 43; p++) {
        for (size_t c = 0; c < 3; c++) {
            const double less =
                (double)all.image.pixels[4 * p + c] - (double)found.pixels[4 * p + c];
            assert_true(less >= -rounding && less <= (double)dropped[p] + rounding);
            most = fmax(most, less);
        }
    }
    assert_true(most > 1e-3);
    glint_image_free(&found);
    glint_terms_free(&terms);
    test_frame_free(&all);
    test_frame_free(&few);
    glint_environment_free(&environment);
}

static void files_without_terms_are_refused(void **state)
{
    (void)state;
    glint_terms terms;
    glint_error error = {0};
    glint_image image;
    assert_int_equal(glint_image_create(2, 2, 4, &image, NULL), GLINT_OK);
    float values[4] = {0};
    static const char *const incomplete[] = {"terms.00.x", "terms.constant_r"};
    for (int i = 0; i < 3; i++) {
        const glint_channel channel = {i < 2 ? incomplete[i] : "depth.surfaces", values};
        const glint_write_options options = {.channels = &channel, .channel_count = 1};
        assert_int_equal(glint_image_write(scratch_path("none.exr"), &image, &options, &error),
                         GLINT_OK);
        assert_int_equal(glint_terms_read(scratch_path("none.exr"), &terms, &error),
                         GLINT_BAD_INPUT);
        assert_non_null(strstr(error.message, "it holds no directions"));
    }
    scratch_write("text.exr", "no picture", -1);
    assert_int_equal(glint_terms_read(scratch_path("text.exr"), &terms, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "is no image"));
    assert_int_equal(glint_image_write(scratch_path("a.png"), &image, NULL, NULL), GLINT_OK);
    assert_int_equal(glint_terms_read(scratch_path("a.png"), &terms, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "is no EXR"));
    assert_int_equal(glint_terms_read(scratch_path("missing.exr"), &terms, &error),
                     GLINT_BAD_INPUT);
    glint_image_free(&image);
}

// A file from elsewhere may hold any value: non-finite values pass through, and nothing else is
// lost.
static void what_is_no_number_stays_one(void **state)
{
    (void)state;
    static const char *const names[] = {"terms.00.kind",    "terms.00.wb",      "terms.00.wg",
                                        "terms.00.wr",      "terms.00.x",       "terms.00.y",
                                        "terms.00.z",       "terms.constant_b", "terms.constant_g",
                                        "terms.constant_r", "terms.dropped"};
    float values[11][3] = {{0, 0, 1},          {1, 1, 1}, {1, NAN, 1}, {1, 1, 1},
                           {NAN, 0, INFINITY}, {0, 1, 0}, {0, 0, 0},   {0, 0, 0},
                           {0, 0, 0},          {0, 0, 0}, {NAN, 0, -1}};
    glint_channel channels[11];
    for (int i = 0; i < 11; i++) {
        channels[i] = (glint_channel){names[i], values[i]};
    }
    glint_environment environment;
    glint_image image, found;
    glint_terms terms;
    glint_error error = {0};
    const glint_write_options options = {.channels = channels, .channel_count = 11};
    bridge_direction_environment(16, &environment);
    assert_int_equal(glint_image_create(3, 1, 4, &image, NULL), GLINT_OK);
    assert_int_equal(glint_image_write(scratch_path("nan.exr"), &image, &options, &error),
                     GLINT_OK);
    assert_int_equal(glint_terms_read(scratch_path("nan.exr"), &terms, &error), GLINT_OK);
    assert_true(terms.dropped == 0);
    assert_int_equal(glint_terms_relight(&terms, &environment, 0, &found, &error), GLINT_OK);
    assert_int_equal(glint_image_count_nonfinite(&found), 3);
    assert_true(fabs((double)found.pixels[4] - 0.5) < 1e-2 && isnan(found.pixels[5]));
    glint_image_free(&found);
    glint_image_free(&image);
    glint_terms_free(&terms);
    glint_environment_free(&environment);
}

static int setup(void **state)
{
    return scratch_setup(state);
}

static int teardown(void **state)
{
    test_close_device(state);
    return scratch_teardown(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_frame_lit_anew_is_a_frame),
        cmocka_unit_test(of_samples_and_of_holes_too),
        cmocka_unit_test(packets_of_1_8_and_16_rays_keep_the_same),
        cmocka_unit_test(what_finds_no_room_is_the_lightest_and_is_counted),
        cmocka_unit_test(files_without_terms_are_refused),
        cmocka_unit_test(what_is_no_number_stays_one),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
