// Tests golden images: every scene of scenes/ at 96 × 54 in the built-in studio, against the images
// in tests/golden. Goldens detect unintended changes. test_agreement.c tests correctness.
//
// A missing golden fails. Only `test_golden --update` (the target update_golden) makes goldens.
// Look
// at them before you commit them.
//
// Processors with a fused multiply-add (AVX2, AVX-512) give the same bits. Processors without it
// (SSE) round otherwise and select other surfaces at a few edges. There no golden holds, and
// tests/targets bounds the differences.
#include "image/image_io.h"
#include "support/render.h"

#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

// Goldens are stored as half. This rounds a value by at most 2⁻¹¹ of it, and by 2⁻²⁵ if the half is
// subnormal. There may be no other difference.
#define RELATIVE_TOLERANCE 0x1p-11f
#define ABSOLUTE_TOLERANCE 0x1p-25f

#define WIDTH 96
#define HEIGHT 54

typedef struct scene_list {
    char names[64][64];
    size_t count;
} scene_list;

// Lists every scene of scenes/, so that no new scene is forgotten.
static void list_scenes(scene_list *list)
{
    glob_t found;
    assert_int_equal(glob(GLINT_SOURCE_DIR "/scenes/*.gltf", 0, NULL, &found), 0);
    assert_true(found.gl_pathc <= sizeof list->names / sizeof *list->names);
    list->count = found.gl_pathc;
    for (size_t i = 0; i < list->count; i++) {
        const char *name = strrchr(found.gl_pathv[i], '/') + 1;
        int length = (int)(strlen(name) - strlen(".gltf"));
        snprintf(list->names[i], sizeof list->names[i], "%.*s", length, name);
    }
    globfree(&found);
}

static void golden_path(const char *name, char *path, size_t capacity)
{
    snprintf(path, capacity, "%s/tests/golden/%s.exr", GLINT_SOURCE_DIR, name);
}

static void render_scene(const char *name, test_frame *frame)
{
    glint_scene scene = {0};
    test_scene_load(name, &scene);
    glint_settings settings = glint_settings_default;
    settings.width = WIDTH;
    settings.height = HEIGHT;
    settings.samples_per_axis = 2;
    test_render(&scene, test_studio(), NULL, &settings, frame);
    glint_scene_free(&scene);
}

static bool differs(const float *golden, const float *now)
{
    for (int k = 0; k < 4; k++) {
        float tolerance = fmaxf(RELATIVE_TOLERANCE * fabsf(now[k]), ABSOLUTE_TOLERANCE);
        // NaN differs from everything.
        if (!(fabsf(golden[k] - now[k]) <= tolerance)) {
            return true;
        }
    }
    return false;
}

// Counts the pixels that differ from the golden. Without a golden all pixels count.
static size_t count_differences(const char *name)
{
    char path[4096];
    golden_path(name, path, sizeof path);
    glint_image golden;
    glint_error error = {0};
    if (glint_image_read(path, &golden, NULL, &error) != GLINT_OK) {
        print_error("%s (goldens are made by the target update_golden)\n", error.message);
        return WIDTH * HEIGHT;
    }
    test_frame frame;
    render_scene(name, &frame);
    assert_int_equal(golden.width, frame.image.width);
    assert_int_equal(golden.height, frame.image.height);
    assert_int_equal(golden.channels, 4);
    size_t different = 0;
    for (size_t p = 0; p < WIDTH * HEIGHT; p++) {
        different += differs(golden.pixels + 4 * p, frame.image.pixels + 4 * p);
    }
    glint_image_free(&golden);
    test_frame_free(&frame);
    return different;
}

static void scenes_look_as_they_did(void **state)
{
    (void)state;
#ifdef __x86_64__
    if (!__builtin_cpu_supports("fma")) {
        skip();
    }
#endif
    scene_list scenes;
    list_scenes(&scenes);
    size_t failures = 0;
    for (size_t i = 0; i < scenes.count; i++) {
        size_t different = count_differences(scenes.names[i]);
        if (different > 0) {
            print_error("%s: %zu pixels differ\n", scenes.names[i], different);
            failures++;
        }
    }
    assert_int_equal(failures, 0);
}

static void update_goldens(void **state)
{
    (void)state;
    scene_list scenes;
    list_scenes(&scenes);
    for (size_t i = 0; i < scenes.count; i++) {
        test_frame frame;
        render_scene(scenes.names[i], &frame);
        char path[4096];
        golden_path(scenes.names[i], path, sizeof path);
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
