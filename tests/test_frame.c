// Tests properties of rendered frames that hold for every scene: the same bits at every packet
// width and with every feature compiled, exact environments, alpha, samples, counters,
// interruption.
#include "device/opencl.h"
#include "render/settings_table.h"
#include "support/bridge.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Uses half texels in single precision and float texels in double. One scene uses cones.
static void packets_of_1_8_and_16_rays_give_the_same_bits(void **state)
{
    (void)state;
    static const char *const names[] = {"materials", "nested_glass", "absorption_box", "lights"};
    // Widths and tiles. The last two are for the scene with all features.
    static const int forms[][2] = {{8, 16}, {16, 16}, {16, 1}, {1, 16}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        for (int precision = 0; precision < (i == 0 ? 2 : 1); precision++) {
            glint_settings settings = test_small_frame(0);
            settings.precision = precision ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
            settings.filter = i == 1 ? GLINT_FILTER_MIP : GLINT_FILTER_BILINEAR;
            settings.kernel_width = 1;
            settings.tile_packets = 1;
            test_frame one, more;
            test_render_named(names[i], &settings, &one);
            assert_int_equal(one.plan.half_texels, precision == 0);
            for (size_t w = 0; w < (i == 1 ? 4 : 2); w++) {
                settings.kernel_width = forms[w][0];
                settings.tile_packets = forms[w][1];
                test_render_named(names[i], &settings, &more);
                assert_int_equal(test_count_different(&one.image, &more.image), 0);
                assert_memory_equal(&one.report.rays, &more.report.rays, sizeof one.report.rays);
                test_frame_free(&more);
            }
            test_frame_free(&one);
        }
    }
}

// Texels in [0, 1] err by at most 2⁻¹² as halfs, and so does their interpolation. A pixel's weights
// add up to at most 1. Paths do not depend on texels.
static void half_texels_change_a_frame_by_their_rounding_alone(void **state)
{
    (void)state;
    static const char *const names[] = {"mirror_sphere", "materials", "nested_glass"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        glint_settings settings = test_small_frame(0);
        test_frame half, whole;
        settings.texels = GLINT_TEXELS_HALF;
        test_render_named(names[i], &settings, &half);
        settings.texels = GLINT_TEXELS_FLOAT;
        test_render_named(names[i], &settings, &whole);
        assert_true(half.plan.half_texels && !whole.plan.half_texels);
        assert_memory_equal(&half.report.rays, &whole.report.rays, sizeof half.report.rays);
        size_t different = 0;
        for (size_t p = 0; p < 4 * 61 * 43; p++) {
            double difference = fabs(half.exact[p] - whole.exact[p]);
            assert_true(difference <= 0x1p-12 + 16 * 0x1p-24);
            different += difference > 0x1p-20;
        }
        assert_true(different > 61 * 43);
        test_frame_free(&half);
        test_frame_free(&whole);
    }
}

// Random light and dark texels.
static void noise_environment(int edge, glint_environment *environment)
{
    *environment = (glint_environment){.layout = GLINT_LAYOUT_CUBE};
    assert_int_equal(glint_cube_create(edge, &environment->radiance, NULL), GLINT_OK);
    uint32_t random = 1;
    for (int k = 0; k < 6 * edge * edge; k++) {
        float *texel =
            glint_cube_texel(&environment->radiance, k / edge / edge, k % edge, k / edge % edge);
        random = random * 1664525u + 1013904223u;
        texel[0] = texel[1] = texel[2] = (float)(random >> 31);
    }
    glint_cube_fill_border(&environment->radiance);
}

static double rmse_between(const test_frame *a, const test_frame *b)
{
    double sum = 0;
    for (size_t p = 0; p < 4 * 61 * 43; p++) {
        sum += (a->exact[p] - b->exact[p]) * (a->exact[p] - b->exact[p]);
    }
    return sqrt(sum / (4 * 61 * 43));
}

// Asserts that one cone a pixel is closer to the mean of 64 look-ups than one look-up is, by this
// factor, for a mirror and for glass.
static void assert_cones_are_closer(const glint_environment *environment, double factor)
{
    static const char *const names[] = {"mirror_sphere", "glass_sphere"};
    for (size_t i = 0; i < 2; i++) {
        glint_scene scene = {0};
        test_scene_load(names[i], &scene);
        glint_settings settings = test_small_frame(3);
        test_frame one, cones, many;
        test_render(&scene, environment, NULL, &settings, &one);
        settings.filter = GLINT_FILTER_MIP;
        test_render(&scene, environment, NULL, &settings, &cones);
        settings.filter = GLINT_FILTER_BILINEAR;
        settings.samples_per_axis = 8;
        test_render(&scene, environment, NULL, &settings, &many);
        assert_memory_equal(&one.report.rays, &cones.report.rays, sizeof one.report.rays);
        const double without = rmse_between(&one, &many), with = rmse_between(&cones, &many);
        print_message("%s: %.4f without cones, %.4f with\n", names[i], without, with);
        assert_true(with < factor * without);
        test_frame_free(&one);
        test_frame_free(&cones);
        test_frame_free(&many);
        glint_scene_free(&scene);
    }
}

// If texels are much finer than pixels, one look-up errs at random by half of the range. A cone
// averages several texels. Its levels are half a level finer than the cone, so it averages at least
// two texels along each axis. The mean of four halves the error.
static void cones_see_what_many_samples_see(void **state)
{
    (void)state;
    glint_environment noise;
    noise_environment(512, &noise);
    assert_cones_are_closer(&noise, 0.5);
    glint_environment_free(&noise);
}

// Light from half of all directions. A cone that is too wide blurs the border, and is then farther
// from many samples than one look-up.
static void cones_are_no_wider_than_what_is_seen(void **state)
{
    (void)state;
    const int edge = 512;
    glint_environment half;
    noise_environment(edge, &half);
    for (int k = 0; k < 6 * edge * edge; k++) {
        const int face = k / edge / edge, i = k % edge, j = k / edge % edge;
        const glint_vec3 d =
            glint_cube_direction(face, (2.0 * i + 1) / edge - 1, (2.0 * j + 1) / edge - 1);
        float *texel = glint_cube_texel(&half.radiance, face, i, j);
        texel[0] = texel[1] = texel[2] = d.x + 0.3 * d.y + 0.2 * d.z > 0.1 ? 1 : 0;
    }
    glint_cube_fill_border(&half.radiance);
    assert_cones_are_closer(&half, 1);
    glint_environment_free(&half);
}

// If a pixel sees less than a texel, there is nothing to average.
static void cones_change_nothing_where_texels_are_wide(void **state)
{
    (void)state;
    glint_scene scene = {0};
    test_scene_load("mirror_sphere", &scene);
    glint_environment noise;
    noise_environment(4, &noise);
    glint_settings settings = test_small_frame(2);
    test_frame bilinear, cones;
    test_render(&scene, &noise, NULL, &settings, &bilinear);
    settings.filter = GLINT_FILTER_MIP;
    test_render(&scene, &noise, NULL, &settings, &cones);
    assert_int_equal(test_count_different(&bilinear.image, &cones.image), 0);
    test_frame_free(&bilinear);
    test_frame_free(&cones);
    glint_environment_free(&noise);
    glint_scene_free(&scene);
}

static void features_that_a_scene_does_not_need_change_nothing(void **state)
{
    (void)state;
    static const char *const names[] = {"mirror_sphere",     "glass_sphere", "thin_wall",
                                        "lecture_example_2", "materials",    "lights"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        glint_settings settings = test_small_frame(4);
        test_frame minimal, everything;
        test_render_named(names[i], &settings, &minimal);
        settings.all_features = true;
        test_render_named(names[i], &settings, &everything);
        assert_int_equal(test_count_different(&minimal.image, &everything.image), 0);
        assert_true(glint_plan_feature_count(&minimal.plan) <
                    glint_plan_feature_count(&everything.plan));
        test_frame_free(&minimal);
        test_frame_free(&everything);
    }
}

// Compares the device's rotation of the environment with the oracle's.
static void the_environment_turns_counter_clockwise_seen_from_above(void **state)
{
    (void)state;
    glint_scene scene = {0}; // only the environment
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    bridge *b = bridge_create(&scene, &environment);
    glint_settings settings = test_small_frame(1);
    settings.env_rotate = 90;
    settings.texels = GLINT_TEXELS_FLOAT;
    test_frame frame;
    test_render(&scene, &environment, NULL, &settings, &frame);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    oracle_view view = bridge_view(&camera, &settings);
    oracle_scene turned = *bridge_scene(b);
    turned.environment_rotation = 90;
    for (int i = 0; i < settings.width * settings.height; i++) {
        const int pixel[2] = {i % settings.width, i / settings.width};
        double rgba[4];
        oracle_pixel(&turned, &view, pixel, rgba, NULL);
        for (int k = 0; k < 4; k++) {
            assert_true(fabs(frame.exact[4 * i + k] - rgba[k]) < 2e-6);
        }
    }
    // The default camera looks along −Z. After a rotation by 90° it sees the former +X at the
    // centre.
    const float *centre = glint_image_pixel(&frame.image, settings.width / 2, settings.height / 2);
    assert_true(fabsf(centre[0] - 1) < 0.01f && fabsf(centre[2] - 0.5f) < 0.05f);
    test_frame_free(&frame);
    bridge_free(b);
    glint_environment_free(&environment);
}

static void a_sample_grid_is_the_mean_of_its_samples(void **state)
{
    (void)state;
    glint_settings settings = test_small_frame(2);
    settings.samples_per_axis = 3;
    glint_scene scene = {0};
    test_scene_load("mirror_sphere", &scene);
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    test_frame frame;
    test_render(&scene, &environment, NULL, &settings, &frame);
    bridge *b = bridge_create(&scene, &environment);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    oracle_view view = bridge_view(&camera, &settings);
    size_t different = 0;
    for (int i = 0; i < settings.width * settings.height; i++) {
        const int pixel[2] = {i % settings.width, i / settings.width};
        double rgba[4];
        oracle_pixel(bridge_scene(b), &view, pixel, rgba, NULL);
        different += fabs(frame.exact[4 * i] - rgba[0]) > 1e-3;
    }
    assert_true(different <= 3);
    assert_int_equal(frame.report.rays.primary, 61 * 43 * 9);
    bridge_free(b);
    test_frame_free(&frame);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static void a_transparent_background_is_left_out_and_surfaces_stay_whole(void **state)
{
    (void)state;
    glint_settings settings = test_small_frame(0);
    test_frame opaque, transparent;
    test_render_named("glass_sphere", &settings, &opaque);
    settings.transparent = true;
    test_render_named("glass_sphere", &settings, &transparent);
    size_t covered = 0, left_out = 0;
    for (size_t i = 0; i < 61 * 43; i++) {
        const float *a = opaque.image.pixels + 4 * i, *b = transparent.image.pixels + 4 * i;
        assert_true(a[3] == 1);
        if (b[3] == 1) { // glass is opaque, too: its colour includes the background
            assert_memory_equal(a, b, 4 * sizeof *a);
            covered++;
        } else {
            assert_true(b[0] == 0 && b[1] == 0 && b[2] == 0 && b[3] == 0);
            left_out++;
        }
    }
    assert_true(covered > 300 && left_out > 300);
    test_frame_free(&opaque);
    test_frame_free(&transparent);
}

static void a_colour_behind_the_scene_fills_what_is_left_open(void **state)
{
    (void)state;
    static const char *const texts[] = {"0.25,0,3e2", "0,0,0"};
    const glint_setting *background = glint_setting_at(offsetof(glint_settings, transparent));
    glint_settings settings = test_small_frame(0);
    settings.samples_per_axis = 2; // so that edges have partial alpha
    settings.transparent = true;
    test_frame open_frame, filled;
    test_render_named("glass_sphere", &settings, &open_frame);
    for (size_t k = 0; k < 2; k++) {
        assert_int_equal(glint_option_parse(&background->option, texts[k], &settings, NULL),
                         GLINT_OK);
        test_render_named("glass_sphere", &settings, &filled);
        size_t partly = 0;
        for (size_t i = 0; i < 61 * 43; i++) {
            const float *a = open_frame.image.pixels + 4 * i, *b = filled.image.pixels + 4 * i;
            partly += a[3] > 0 && a[3] < 1;
            assert_true(b[3] == 1);
            for (int c = 0; c < 3; c++) {
                const double whole = (double)a[c] + (1 - (double)a[3]) * settings.backdrop[c];
                assert_true(fabs((double)b[c] - whole) <= 0x1p-24 * whole); // rounded once
            }
        }
        assert_true(partly > 30);
        test_frame_free(&filled);
    }
    test_frame_free(&open_frame);
    assert_true(settings.backdrop[3] == 1); // black is a backdrop, too
    static const char *const wrong[] = {"-1,0,0", "1,2", "1,2,3,4", "nan,0,0", "1, 2,3"};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        assert_int_equal(glint_option_parse(&background->option, wrong[k], &settings, NULL),
                         GLINT_USAGE);
    }
    assert_int_equal(glint_option_parse(&background->option, "env", &settings, NULL), GLINT_OK);
    assert_true(!settings.transparent && settings.backdrop[3] == 0);
}

static void light_that_is_cut_off_is_reported_and_never_black(void **state)
{
    (void)state;
    glint_settings settings = test_small_frame(1);
    test_frame frame;
    test_render_named("facing_mirrors", &settings, &frame);
    assert_true(frame.report.truncation.by_depth > 0.3);
    for (size_t i = 0; i < 61 * 43; i++) {
        const float *p = frame.image.pixels + 4 * i;
        assert_true(p[0] + p[1] + p[2] > 0.1f);
    }
    test_frame_free(&frame);
    settings = test_small_frame(0);
    settings.min_weight = 0.25;
    test_render_named("glass_sphere", &settings, &frame);
    assert_true(frame.report.truncation.by_min_weight > 0.01);
    assert_true(frame.report.truncation.by_stack == 0);
    test_frame_free(&frame);
}

static void rays_are_counted_by_class(void **state)
{
    (void)state;
    glint_settings settings = test_small_frame(1);
    test_frame frame;
    test_render_named("mirror_sphere", &settings, &frame);
    const glint_ray_counts *rays = &frame.report.rays;
    assert_int_equal(rays->primary, 61 * 43);
    assert_true(rays->reflected > 0 && rays->reflected < rays->primary);
    assert_int_equal(rays->refracted_in + rays->refracted_out + rays->transmitted, 0);
    assert_int_equal(frame.report.deepest, 1);
    test_frame_free(&frame);
    test_render_named("glass_sphere", &settings, &frame);
    assert_int_equal(rays->refracted_in, rays->reflected);
    assert_int_equal(rays->refracted_out, 0);
    test_frame_free(&frame);
}

static bool stop_at_once(void *context, uint64_t done, uint64_t total)
{
    int *calls = context;
    (*calls)++;
    assert_true(done > 0 && done <= total);
    return false;
}

static void a_device_with_memory_of_its_own_makes_the_same_frame(void **state)
{
    (void)state;
    glint_scene scene = {0};
    test_scene_load("materials", &scene);
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    glint_settings settings = test_small_frame(1);
    glint_capabilities *capabilities = &test_device()->capabilities;
    const bool shares = capabilities->shares_memory;
    test_frame shared, copied;
    test_render(&scene, &environment, NULL, &settings, &shared);
    capabilities->shares_memory = false;
    test_render(&scene, &environment, NULL, &settings, &copied);
    capabilities->shares_memory = shares;
    assert_int_equal(test_count_different(&shared.image, &copied.image), 0);
    test_frame_free(&shared);
    test_frame_free(&copied);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static void a_frame_that_is_stopped_leaves_no_image(void **state)
{
    (void)state;
    glint_scene scene = {0};
    test_scene_load("mirror_sphere", &scene);
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    glint_settings settings = test_small_frame(1);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &scene,
                                          .environment = &environment,
                                          .settings = &settings};
    glint_renderer *renderer;
    assert_int_equal(glint_renderer_create(&inputs, &renderer, NULL), GLINT_OK);
    int calls = 0;
    const glint_progress progress = {stop_at_once, &calls};
    glint_image image = {0};
    glint_error error = {0};
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){renderer, &camera, &progress, &image, NULL},
                             &error),
        GLINT_INTERRUPTED);
    assert_int_equal(calls, 1);
    assert_null(image.pixels);
    glint_renderer_free(renderer);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
}

static void a_frame_that_the_device_cannot_hold_is_refused_at_once(void **state)
{
    (void)state;
    glint_scene scene = {0};
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    glint_settings settings = test_small_frame(1);
    settings.width = settings.height = 65536; // 64 GiB
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &scene,
                                          .environment = &environment,
                                          .settings = &settings};
    glint_renderer *renderer;
    glint_error error = {0};
    assert_int_equal(glint_renderer_create(&inputs, &renderer, &error), GLINT_DEVICE_LACKS);
    assert_null(renderer);
    assert_non_null(strstr(error.message, "the frame needs 65536 MiB"));
    glint_environment_free(&environment);
}

static void a_kernel_that_does_not_compile_is_reported_with_its_file(void **state)
{
    (void)state;
    glint_scene scene = {0};
    glint_environment environment;
    bridge_direction_environment(32, &environment);
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    glint_settings settings = test_small_frame(1);
    glint_renderer_inputs inputs = {.device = test_device(),
                                    .scene = &scene,
                                    .environment = &environment,
                                    .settings = &settings,
                                    .kernel_dir = GLINT_SOURCE_DIR "/tests/broken_kernels"};
    glint_renderer *renderer;
    glint_error error = {0};
    assert_int_equal(glint_renderer_create(&inputs, &renderer, &error), GLINT_DEVICE_FAILED);
    assert_non_null(error.details);
    assert_non_null(strstr(error.details, "render.cl"));
    glint_error_free(&error);
    inputs.kernel_dir = GLINT_SOURCE_DIR "/tests";
    assert_int_equal(glint_renderer_create(&inputs, &renderer, &error), GLINT_BAD_INPUT);
    glint_environment_free(&environment);
}

// bridge_direction_environment has only bands 0 and 1, which harmonics represent exactly. The rest
// is the error of texels taken as even squares (h²/24 of second derivatives under 4, h = 2/32), the
// similar interpolation error of the map, and rounding.
static void harmonics_light_paint_as_the_map_does(void **state)
{
    (void)state;
    const int widths[] = {1, 8, 16};
    glint_settings settings = test_small_frame(2);
    test_frame exact, by_harmonics;
    test_render_named("lecture_example_2", &settings, &exact);
    assert_false(exact.plan.features[GLINT_FEATURE_IRRADIANCE_HARMONICS].compiled);
    settings.irradiance = GLINT_IRRADIANCE_SH;
    for (int i = 0; i < 3; i++) {
        settings.kernel_width = widths[i];
        test_render_named("lecture_example_2", &settings, &by_harmonics);
        assert_true(by_harmonics.plan.features[GLINT_FEATURE_IRRADIANCE_HARMONICS].compiled);
        double worst = 0;
        for (size_t k = 0; k < 61 * 43 * 4; k++) {
            worst = fmax(
                worst, fabs((double)exact.image.pixels[k] - (double)by_harmonics.image.pixels[k]));
        }
        assert_true(worst <= 2 * 4.0 / 32 / 32 / 24 * 4);
        test_frame_free(&by_harmonics);
    }
    test_frame_free(&exact);
    // The scene has no paint, so no harmonics are compiled.
    test_render_named("mirror_sphere", &settings, &by_harmonics);
    assert_false(by_harmonics.plan.features[GLINT_FEATURE_IRRADIANCE_HARMONICS].compiled);
    test_frame_free(&by_harmonics);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_of_1_8_and_16_rays_give_the_same_bits),
        cmocka_unit_test(half_texels_change_a_frame_by_their_rounding_alone),
        cmocka_unit_test(cones_see_what_many_samples_see),
        cmocka_unit_test(cones_are_no_wider_than_what_is_seen),
        cmocka_unit_test(cones_change_nothing_where_texels_are_wide),
        cmocka_unit_test(harmonics_light_paint_as_the_map_does),
        cmocka_unit_test(features_that_a_scene_does_not_need_change_nothing),
        cmocka_unit_test(the_environment_turns_counter_clockwise_seen_from_above),
        cmocka_unit_test(a_sample_grid_is_the_mean_of_its_samples),
        cmocka_unit_test(a_transparent_background_is_left_out_and_surfaces_stay_whole),
        cmocka_unit_test(a_colour_behind_the_scene_fills_what_is_left_open),
        cmocka_unit_test(light_that_is_cut_off_is_reported_and_never_black),
        cmocka_unit_test(rays_are_counted_by_class),
        cmocka_unit_test(a_device_with_memory_of_its_own_makes_the_same_frame),
        cmocka_unit_test(a_frame_that_is_stopped_leaves_no_image),
        cmocka_unit_test(a_frame_that_the_device_cannot_hold_is_refused_at_once),
        cmocka_unit_test(a_kernel_that_does_not_compile_is_reported_with_its_file),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
