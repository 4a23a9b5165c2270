// Golden images: every scene of scenes/ at 96 × 54 in the built-in studio, against the pictures in
// tests/golden. They guard against changes that nobody meant; whether a picture is right is the
// oracle's to judge (test_agreement.c).
//
// A missing golden fails. They are only made by `test_golden --update` (the target update_golden);
// look at them before committing them.
#include "image/image_io.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// Goldens are stored as half and looked up in half texels: either rounds by 2⁻¹¹ of the value at
// most. What is beyond 2⁻¹⁰ is a different value, and other targets may decide a few pixels at
// edges otherwise.
#define RELATIVE_TOLERANCE 0x1p-10f
#define DIFFERENT_PIXELS 0.005

static const char *const scene_names[] = {
    "absorption_box", "axes",         "facing_mirrors",    "gallery",
    "glass_slab",     "glass_sphere", "lecture_example_2", "materials",
    "mirror_sphere",  "nested_glass", "orthographic",      "prism",
    "thin_wall",
};
#define SCENE_COUNT (sizeof scene_names / sizeof *scene_names)

static void golden_path(const char *name, char *path, size_t capacity)
{
    snprintf(path, capacity, "%s/tests/golden/%s.exr", GLINT_SOURCE_DIR, name);
}

static void render_scene(const char *name, test_frame *frame)
{
    glint_scene scene = {0};
    test_scene_load(name, &scene);
    glint_environment environment;
    assert_int_equal(glint_environment_studio(&environment, NULL), GLINT_OK);
    glint_settings settings = glint_settings_default;
    settings.width = 96;
    settings.height = 54;
    settings.samples_per_axis = 2;
    test_render(&scene, &environment, NULL, &settings, frame);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static bool differs(const float *a, const float *b)
{
    for (int k = 0; k < 4; k++) {
        float tolerance = RELATIVE_TOLERANCE * fmaxf(fabsf(a[k]), 0x1p-6f);
        // NaN differs from everything.
        if (!(fabsf(a[k] - b[k]) <= tolerance)) {
            return true;
        }
    }
    return false;
}

static void scenes_look_as_they_did(void **state)
{
    (void)state;
    int failures = 0;
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        char path[4096];
        golden_path(scene_names[i], path, sizeof path);
        glint_image golden;
        glint_error error = {0};
        if (glint_image_read(path, &golden, NULL, &error) != GLINT_OK) {
            print_error("%s (goldens are made by the target update_golden)\n", error.message);
            failures++;
            continue;
        }
        test_frame frame;
        render_scene(scene_names[i], &frame);
        assert_int_equal(golden.width, frame.image.width);
        assert_int_equal(golden.height, frame.image.height);
        assert_int_equal(golden.channels, 4);
        size_t different = 0, pixels = 96 * 54;
        for (size_t p = 0; p < pixels; p++) {
            different += differs(golden.pixels + 4 * p, frame.image.pixels + 4 * p);
        }
        if ((double)different > DIFFERENT_PIXELS * (double)pixels) {
            print_error("%s: %zu of %zu pixels differ\n", scene_names[i], different, pixels);
            failures++;
        }
        glint_image_free(&golden);
        test_frame_free(&frame);
    }
    assert_int_equal(failures, 0);
}

static void update_goldens(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        test_frame frame;
        render_scene(scene_names[i], &frame);
        char path[4096];
        golden_path(scene_names[i], path, sizeof path);
        assert_int_equal(glint_image_write(path, &frame.image, NULL, NULL), GLINT_OK);
        print_message("wrote %s\n", path);
        test_frame_free(&frame);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(scenes_look_as_they_did)};
    const struct CMUnitTest update[] = {cmocka_unit_test(update_goldens)};
    bool updating = argc > 1 && strcmp(argv[1], "--update") == 0;
    return updating ? cmocka_run_group_tests(update, NULL, test_close_device)
                    : cmocka_run_group_tests(tests, NULL, test_close_device);
}
