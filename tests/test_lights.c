// Tests punctual lights against closed forms: the light on a floor, cones and range, and cases
// without lights.
#include "support/lit_floor.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// ---- Light on the floor -------------------------------------------------------------------------

static void check_points(const glint_settings *settings)
{
    static const double ranges[] = {INFINITY, 0.9, 1e-3};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        lit_floor s;
        test_frame frame;
        lit_floor_begin(&s, &flat_floor);
        lit_floor_add_light(&s, &floor_lamp);
        s.lights[0].range = ranges[i];
        lit_floor_render(&s, settings, &frame);
        lit_floor_expect_everywhere(&(lit_frame){&s, settings, &frame, &flat_floor}, lit_fully,
                                    LIT_FLOOR_SLACK);
        const uint64_t pixels = (uint64_t)settings->width * (uint64_t)settings->height;
        assert_true(i != 0 || frame.report.rays.shadow == pixels);
        assert_true(i != 1 ||
                    (frame.report.rays.shadow > pixels / 8 && frame.report.rays.shadow < pixels));
        assert_true(i != 2 || frame.report.rays.shadow == 0);
        test_frame_free(&frame);
    }
}

static void points_fall_off_by_the_square_within_their_range(void **state)
{
    (void)state;
    lit_floor_in_both(check_points);
}

static void check_spots(const glint_settings *settings)
{
    static const double cones[][2] = {{0.2, 0.5}, {0, 0.02}, {0.4999, 0.5}, {0, 1.5707963}};
    for (size_t i = 0; i < sizeof cones / sizeof *cones; i++) {
        lit_floor s;
        test_frame frame;
        lit_floor_begin(&s, &flat_floor);
        const glint_vec3 aim = glint_vec3_normalize((glint_vec3){0.1, -1, 0.05});
        lit_floor_add_light(&s, &(glint_punctual_light){.kind = GLINT_PUNCTUAL_SPOT,
                                                        .position = {-0.125, 0.6875, 0.0625},
                                                        .direction = aim,
                                                        .color = {1, 2, 3},
                                                        .range = INFINITY,
                                                        .inner_angle = cones[i][0],
                                                        .outer_angle = cones[i][1]});
        lit_floor_render(&s, settings, &frame);
        // The cone multiplies the error of the cosine by up to 1000; the square counts, too.
        const double scale = 1 / fmax(0.001, cos(cones[i][0]) - cos(cones[i][1]));
        lit_floor_expect_everywhere(&(lit_frame){&s, settings, &frame, &flat_floor}, lit_fully,
                                    LIT_FLOOR_SLACK + 16 * scale);
        test_frame_free(&frame);
    }
}

static void spots_have_soft_cones(void **state)
{
    (void)state;
    lit_floor_in_both(check_spots);
}

static void check_suns(const glint_settings *settings)
{
    lit_floor s;
    test_frame frame;
    const sheet slanted = {.half = 0.875, .y = LIT_FLOOR_Y, .slope = 0.25, .parts = 4};
    lit_floor_begin(&s, &slanted);
    lit_floor_add_light(
        &s, &(glint_punctual_light){.kind = GLINT_PUNCTUAL_DIRECTIONAL,
                                    .position = {1e300, NAN, 0},
                                    .direction = glint_vec3_normalize((glint_vec3){0.3, -0.8, 0.2}),
                                    .color = {1, 2, 3},
                                    .range = INFINITY});
    lit_floor_add_light(&s, &floor_lamp); // lights add up
    lit_floor_render(&s, settings, &frame);
    lit_floor_expect_everywhere(&(lit_frame){&s, settings, &frame, &slanted}, lit_fully,
                                LIT_FLOOR_SLACK);
    test_frame_free(&frame);
}

static void suns_shine_everywhere_alike(void **state)
{
    (void)state;
    lit_floor_in_both(check_suns);
}

// Rule 1: light counts only on the visible side.
static void check_sides(const glint_settings *settings)
{
    for (int from_below = 0; from_below < 2; from_below++) {
        for (int light_below = 0; light_below < 2; light_below++) {
            lit_floor s;
            test_frame frame;
            const sheet seen = {
                .half = 0.875, .y = LIT_FLOOR_Y, .parts = 4, .faces_down = from_below};
            lit_floor_begin(&s, &flat_floor);
            lit_floor_look(&s, from_below ? -2 : 2, from_below);
            lit_floor_add_light(&s, &floor_lamp);
            s.lights[0].position.y = light_below ? -0.8125 : 0.4375;
            lit_floor_render(&s, settings, &frame);
            lit_floor_expect_everywhere(&(lit_frame){&s, settings, &frame, &seen},
                                        from_below == light_below ? lit_fully : lit_not,
                                        LIT_FLOOR_SLACK);
            test_frame_free(&frame);
        }
    }
}

static void a_surface_is_lit_on_the_side_that_is_seen(void **state)
{
    (void)state;
    lit_floor_in_both(check_sides);
}

// A scene of another size, with lights scaled by the square, gives the same bits.
static void sizes_change_nothing(void **state)
{
    (void)state;
    const glint_settings settings = test_small_frame(0);
    test_frame frames[3];
    static const double units[3] = {1, 0x1p40, 0x1p-40};
    for (int i = 0; i < 3; i++) {
        lit_floor s;
        const double u = units[i];
        lit_floor_begin(&s, &flat_floor);

        lit_floor_add_light(&s, &floor_lamp);
        s.scene.unit = u;
        glint_punctual_light *light = &s.lights[0];
        light->position = glint_vec3_scale(light->position, u);
        light->range = 1.5 * u;
        for (int k = 0; k < 3; k++) {
            light->color[k] *= u * u;
        }
        s.camera.eye.y *= u;
        s.camera.ymag *= u;
        lit_floor_render(&s, &settings, &frames[i]);
        assert_true(frames[i].report.rays.shadow > 1000);
        assert_int_equal(test_count_different(&frames[0].image, &frames[i].image), 0);
    }
    for (int i = 0; i < 3; i++) {
        test_frame_free(&frames[i]);
    }
}

// ---- Where lights are left out ------------------------------------------------------------------

static void check_left_out(const glint_material *material, const glint_settings *settings,
                           const char *reason)
{
    lit_floor s;
    test_frame with, without;
    lit_floor_begin(&s, &flat_floor);
    s.materials[0] = *material;
    lit_floor_add_light(&s, &floor_lamp);
    lit_floor_render(&s, settings, &with);
    assert_false(with.plan.features[GLINT_FEATURE_LIGHTS].compiled);
    assert_string_equal(with.plan.features[GLINT_FEATURE_LIGHTS].reason, reason);
    assert_true(with.report.rays.shadow == 0);
    s.scene.light_count = 0;
    lit_floor_render(&s, settings, &without);
    assert_int_equal(test_count_different(&with.image, &without.image), 0);
    test_frame_free(&with);
    test_frame_free(&without);
}

static void lights_are_left_out_by_name(void **state)
{
    (void)state;
    glint_material metal = floor_paint, unlit = floor_paint;
    metal.metallic = 1;
    unlit.unlit = true;
    glint_settings settings = test_small_frame(1);
    check_left_out(&metal, &settings, "no material shows lights");
    check_left_out(&unlit, &settings, "no material shows lights");
    settings.lights = GLINT_LIGHTS_NONE;
    check_left_out(&floor_paint, &settings, "lights none");
    settings.lights = GLINT_LIGHTS_FILE;
    settings.shading = GLINT_SHADING_VERTEX_COLOR;
    check_left_out(&floor_paint, &settings, "vertices are shaded, by the environment alone");
}

// Unlit surfaces beside floor_paint keep their colour.
static void unlit_surfaces_ignore_lights(void **state)
{
    (void)state;
    const glint_settings settings = test_small_frame(0);
    lit_floor s;
    test_frame frame;
    lit_floor_begin(&s, &flat_floor);
    lit_floor_add_sheet(&s, &(sheet){0.15625, 0.1875, 0, 1, false}, 1);
    s.materials[1].unlit = true;
    s.materials[1].base_color[1] = 0.375f;
    lit_floor_add_light(&s, &floor_lamp);
    lit_floor_render(&s, &settings, &frame);
    const size_t middle = 4 * ((size_t)21 * 61 + 30);
    assert_true(frame.exact[middle] == (double)0.8f && frame.exact[middle + 1] == 0.375);
    test_frame_free(&frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_fall_off_by_the_square_within_their_range),
        cmocka_unit_test(spots_have_soft_cones),
        cmocka_unit_test(suns_shine_everywhere_alike),
        cmocka_unit_test(a_surface_is_lit_on_the_side_that_is_seen),
        cmocka_unit_test(sizes_change_nothing),
        cmocka_unit_test(lights_are_left_out_by_name),
        cmocka_unit_test(unlit_surfaces_ignore_lights),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
