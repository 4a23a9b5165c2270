// Tests the hits of primary rays (GLINT_OUTPUT_HITS) against the oracle, at every width.
#include "support/bridge.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

static const char *const scene_names[] = {
    "mirror_sphere",  "glass_slab",        "nested_glass", "materials", "orthographic",
    "facing_mirrors", "lecture_example_2", "axes",         "gallery",
};
#define SCENE_COUNT (sizeof scene_names / sizeof *scene_names)

static glint_settings hits_settings(int width)
{
    glint_settings settings = glint_settings_default;
    settings.width = 150;
    settings.height = 83; // not a whole number of packets or tiles
    settings.output = GLINT_OUTPUT_HITS;
    settings.kernel_width = width;
    return settings;
}

typedef struct hit_tally {
    size_t pixels, hits, other_triangle, unexplained;
} hit_tally;

// A pixel may show either surface if its ray passes within rounding of an edge, or meets two
// surfaces at one distance.
static void compare_pixel(const bridge *b, const oracle_view *view, const int pixel[2],
                          const double found[4], hit_tally *tally)
{
    const double position[2] = {pixel[0] + 0.5, pixel[1] + 0.5};
    oracle_ray ray = oracle_primary_ray(view, position);
    oracle_hit wanted = oracle_closest_hit(bridge_scene(b), &ray, -1);
    tally->pixels++;
    tally->hits += wanted.triangle >= 0;
    if ((int)found[3] == wanted.triangle) {
        if (wanted.triangle >= 0) {
            // Barycentric weights of a sliver are as uncertain as the sliver is thin.
            tally->unexplained += fabs(found[1] - wanted.barycentric[1]) > 2e-3;
            tally->unexplained += fabs(found[2] - wanted.barycentric[2]) > 2e-3;
        }
        return;
    }
    tally->other_triangle++;
    double rgba[4];
    oracle_report report;
    oracle_pixel(bridge_scene(b), view, pixel, rgba, &report);
    tally->unexplained += report.edge > 1e-5;
}

static void primary_rays_meet_what_the_oracle_says(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        glint_settings settings = hits_settings(0);
        glint_scene scene = {0};
        test_scene_load(scene_names[i], &scene);
        glint_environment environment;
        bridge_direction_environment(16, &environment);
        test_frame frame;
        test_render(&scene, &environment, NULL, &settings, &frame);
        bridge *b = bridge_create(&scene, &environment);
        glint_camera camera;
        assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
        settings.depth = 1; // the oracle's depth
        oracle_view view = bridge_view(&camera, &settings);
        hit_tally tally = {0};
        for (int y = 0; y < settings.height; y++) {
            for (int x = 0; x < settings.width; x++) {
                const int pixel[2] = {x, y};
                compare_pixel(b, &view, pixel,
                              frame.exact + 4 * ((size_t)y * (size_t)settings.width + (size_t)x),
                              &tally);
            }
        }
        print_message("%-20s %zu of %zu pixels hit, %zu show another triangle than the oracle's\n",
                      scene_names[i], tally.hits, tally.pixels, tally.other_triangle);
        assert_true(tally.hits > 0);
        assert_int_equal(tally.unexplained, 0);
        assert_true(tally.other_triangle <= tally.pixels / 200);
        bridge_free(b);
        test_frame_free(&frame);
        glint_environment_free(&environment);
        glint_scene_free(&scene);
    }
}

static void every_width_and_tile_find_the_same_hits(void **state)
{
    (void)state;
    // Each scene, width and tile compiles a kernel, so the test takes a few scenes only.
    static const char *const few[] = {"orthographic", "facing_mirrors", "gallery"};
    for (size_t i = 0; i < sizeof few / sizeof *few; i++) {
        glint_scene scene = {0};
        test_scene_load(few[i], &scene);
        glint_environment environment;
        bridge_direction_environment(16, &environment);
        test_frame widest, narrower;
        glint_settings settings = hits_settings(16);
        test_render(&scene, &environment, NULL, &settings, &widest);
        static const struct {
            int width, tile;
        } others[] = {{1, 1}, {8, 16}, {16, 1}};
        for (size_t k = 0; k < sizeof others / sizeof *others; k++) {
            settings = hits_settings(others[k].width);
            settings.tile_packets = others[k].tile;
            test_render(&scene, &environment, NULL, &settings, &narrower);
            assert_int_equal(test_count_different(&widest.image, &narrower.image), 0);
            test_frame_free(&narrower);
        }
        test_frame_free(&widest);
        glint_environment_free(&environment);
        glint_scene_free(&scene);
    }
}

static void hits_are_the_same_whatever_else_is_asked_for(void **state)
{
    (void)state;
    glint_scene scene = {0};
    test_scene_load("materials", &scene);
    glint_environment environment;
    bridge_direction_environment(16, &environment);
    glint_settings settings = hits_settings(0);
    test_frame plain, other;
    test_render(&scene, &environment, NULL, &settings, &plain);
    for (int k = 0; k < 2; k++) {
        settings.transparent = k == 0;
        settings.all_features = k == 1;
        test_render(&scene, &environment, NULL, &settings, &other);
        assert_int_equal(test_count_different(&plain.image, &other.image), 0);
        test_frame_free(&other);
    }
    test_frame_free(&plain);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(primary_rays_meet_what_the_oracle_says),
        cmocka_unit_test(every_width_and_tile_find_the_same_hits),
        cmocka_unit_test(hits_are_the_same_whatever_else_is_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
