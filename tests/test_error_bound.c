// Tests error bounds of frames: the chosen settings keep the bound over all pixels of the frame,
// against a reference rendered here, whatever frames came before.
#include "bound/error_bound.h"
#include "image/metrics.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct stage {
    test_stage at;
    glint_image reference;
} stage;

static void open_stage(const char *scene, int width, int height, stage *s)
{
    glint_settings settings = glint_settings_default;
    settings.width = width;
    settings.height = height;
    settings.truncation_squares = true; // use the same kernels for all
    *s = (stage){0};
    test_stage_open(scene, &settings, &s->at);
}

static void close_stage(stage *s)
{
    glint_image_free(&s->reference);
    test_stage_close(&s->at);
}

static void render_within(stage *s, double bound, glint_image *image, glint_error_choice *choice)
{
    glint_error_bound asked;
    glint_frame_report report;
    glint_error_bound_begin(&asked, bound, &s->at.settings);
    glint_error_bound_set_environment(&asked, &s->at.environment->radiance);
    const glint_frame_request request = {s->at.renderer, &s->at.camera, NULL, image, &report};
    assert_int_equal(glint_error_bound_frame(&asked, &request, choice, NULL), GLINT_OK);
    assert_int_equal(image->width, s->at.settings.width);
    assert_int_equal(image->height, s->at.settings.height);
    assert_true(choice->bound == bound && choice->error <= bound);
}

static double error_of(stage *s, const glint_image *image)
{
    glint_metrics metrics;
    if (s->reference.pixels == NULL) {
        glint_rung rung;
        glint_rung_reference(&s->at.settings, true, &rung);
        assert_int_equal(glint_renderer_set_settings(s->at.renderer, &rung.settings, NULL),
                         GLINT_OK);
        assert_int_equal(glint_renderer_frame(&(glint_frame_request){s->at.renderer, &s->at.camera,
                                                                     NULL, &s->reference, NULL},
                                              NULL),
                         GLINT_OK);
    }
    assert_int_equal(glint_metrics_find(image, &s->reference, NULL, &metrics, NULL), GLINT_OK);
    return metrics.relative_rmse;
}

// Renders within bounds and compares with the reference. If the grid is the whole frame, the
// predicted error must match.
static void check_bounds(const char *scene, int width, int height, bool grid_is_frame)
{
    static const double bounds[] = {0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-6};
    stage s;
    open_stage(scene, width, height, &s);
    for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++) {
        glint_image image = {0};
        glint_error_choice choice;
        render_within(&s, bounds[i], &image, &choice);
        const double error = error_of(&s, &image);
        if (error > bounds[i]) {
            fail_msg("%s within %g, by %s: said to err by %g, errs by %g", scene, bounds[i],
                     choice.rung.options, choice.error, error);
        }
        assert_int_equal(choice.grid_is_frame, grid_is_frame);
        // With a large bound, the grid's reference stops a little earlier than the frame's.
        assert_true(!grid_is_frame || fabs(error - choice.grid_error) <= 0.05 * bounds[i]);
        assert_true(choice.frames >= 1 && choice.grids >= 1 && choice.choosing_rays > 0);
        glint_image_free(&image);
    }
    close_stage(&s);
}

static void bounds_are_kept(void **state)
{
    (void)state;
    check_bounds("gallery", 120, 68, true);
    check_bounds("nested_glass", 120, 68, true);
    check_bounds("facing_mirrors", 288, 216, false);
    check_bounds("mirror_sphere", 160, 90, true);
    check_bounds("glass_sphere", 288, 162, false);
    check_bounds("lecture_example_2", 480, 270, false);
    check_bounds("water", 480, 270, false);
}

// In a uniform environment truncation loses light only where surfaces emit light or have a colour.
static void contrast_may_be_the_scenes_own(void **state)
{
    (void)state;
    stage s;
    glint_environment even;
    open_stage("materials", 480, 270, &s);
    assert_int_equal(glint_environment_studio(&even, NULL), GLINT_OK);
    const glint_cube *cube = &even.radiance;
    for (size_t i = 0; i < glint_cube_size(cube); i++) {
        cube->texels[i] = 0.25f;
    }
    s.at.environment = &even;
    assert_int_equal(glint_renderer_set_environment(s.at.renderer, &even, NULL), GLINT_OK);
    for (int i = 1; i <= 3; i++) {
        glint_image image = {0};
        glint_error_choice choice;
        render_within(&s, pow(0.1, i), &image, &choice);
        assert_false(choice.grid_is_frame);
        assert_true(choice.error > 0 && error_of(&s, &image) <= pow(0.1, i));
        glint_image_free(&image);
    }
    close_stage(&s);
    glint_environment_free(&even);
}

// In the gallery single precision errs by about 0.07, in a few pixels that a grid may miss. Here
// the grid misses them, and the choice must not be single precision.
static void what_a_grid_cannot_see_is_reckoned_with(void **state)
{
    (void)state;
    stage s;
    glint_image image = {0};
    glint_error_choice choice;
    open_stage("gallery", 320, 180, &s);
    render_within(&s, 0.02, &image, &choice);
    assert_int_equal(choice.rung.settings.precision, GLINT_PRECISION_DOUBLE);
    assert_true(choice.unseen_of_float == 0 && error_of(&s, &image) <= 0.02);
    glint_settings in_float = choice.rung.settings;
    in_float.precision = GLINT_PRECISION_FLOAT;
    assert_int_equal(glint_renderer_set_settings(s.at.renderer, &in_float, NULL), GLINT_OK);
    assert_int_equal(
        glint_renderer_frame(
            &(glint_frame_request){s.at.renderer, &s.at.camera, NULL, &image, NULL}, NULL),
        GLINT_OK);
    assert_true(error_of(&s, &image) > 0.02);
    glint_image_free(&image);
    close_stage(&s);
}

// A grid that sees no flipped pixel can miss only a few. If the bound allows these few, the choice
// is single precision, and its predicted error includes them.
static void what_a_grid_may_miss_can_be_afforded(void **state)
{
    (void)state;
    stage s;
    glint_image image = {0};
    glint_error_choice choice;
    open_stage("gallery", 480, 270, &s);
    render_within(&s, 0.3, &image, &choice);
    assert_int_not_equal(choice.rung.settings.precision, GLINT_PRECISION_DOUBLE);
    assert_true(choice.unseen_of_float > 0.1 && error_of(&s, &image) <= 0.3);
    glint_image_free(&image);
    close_stage(&s);
}

// Rays between mirrors may pass an edge on the wrong side, in a pixel that a grid misses. A single
// mirror has no such rays.
static void mirrors_that_show_mirrors_have_edges(void **state)
{
    (void)state;
    static const char *const scenes[] = {"mirror_sphere", "lecture_example_2"};
    for (int i = 0; i < 2; i++) {
        stage s;
        glint_image image = {0};
        glint_error_choice choice;
        open_stage(scenes[i], 480, 270, &s);
        render_within(&s, 0.3, &image, &choice);
        assert_int_not_equal(choice.rung.settings.precision, GLINT_PRECISION_DOUBLE);
        assert_false(choice.grid_is_frame);
        assert_true(i == 0 ? choice.unseen_of_float == 0 : choice.unseen_of_float > 0.001);
        glint_image_free(&image);
        close_stage(&s);
    }
}

// A distant glass ball covers a few pixels, mostly between the pixels of the grid. Only the
// finished frame shows its truncation error. The frame is then rendered once more.
static void what_lies_between_is_seen_of_the_frame(void **state)
{
    (void)state;
    stage s;
    int again = 0;
    open_stage("glass_sphere", 480, 270, &s);
    glint_camera *c = &s.at.camera;
    for (int i = 0; i < 4; i++) {
        glint_image image = {0};
        glint_error_choice choice;
        c->eye = glint_vec3_add(c->eye, glint_vec3_scale(c->back, 120));
        c->eye = glint_vec3_add(c->eye, glint_vec3_scale(c->right, 0.3));
        glint_image_free(&s.reference);
        render_within(&s, 1e-4, &image, &choice);
        assert_true(error_of(&s, &image) <= 1e-4);
        again += choice.frames > 1;
        glint_image_free(&image);
    }
    assert_true(again > 0);
    close_stage(&s);
}

// Without light, or with non-finite light, the frame is the reference. Pixels that cannot be
// compared are skipped.
static void odd_light_gets_the_reference(void **state)
{
    (void)state;
    static const float odd[] = {0, INFINITY};
    stage s;
    glint_environment light;
    open_stage("glass_sphere", 480, 270, &s);
    assert_int_equal(glint_environment_studio(&light, NULL), GLINT_OK);
    const glint_cube *cube = &light.radiance;
    s.at.environment = &light;
    for (int i = 0; i < 2; i++) {
        for (size_t k = 0; k < glint_cube_size(cube); k++) {
            cube->texels[k] = i == 0 || k % 997 == 0 ? odd[i] : cube->texels[k] + 1;
        }
        assert_int_equal(glint_renderer_set_environment(s.at.renderer, &light, NULL), GLINT_OK);
        glint_image image = {0};
        glint_error_choice choice;
        render_within(&s, 0.01, &image, &choice);
        glint_image_free(&s.reference);
        assert_true(choice.error == 0 && error_of(&s, &image) == 0);
        assert_int_equal(test_count_different(&image, &s.reference), 0);
        glint_image_free(&image);
    }
    close_stage(&s);
    glint_environment_free(&light);
}

// Thin pictures, and a picture smaller than a grid's step.
static void frames_may_have_any_shape(void **state)
{
    (void)state;
    static const int sizes[][2] = {{40000, 1}, {3, 13000}, {1, 1}};
    for (int i = 0; i < 3; i++) {
        stage s;
        glint_image image = {0};
        glint_error_choice choice;
        open_stage("mirror_sphere", sizes[i][0], sizes[i][1], &s);
        render_within(&s, 0.01, &image, &choice);
        assert_true(error_of(&s, &image) <= 0.01);
        glint_image_free(&image);
        close_stage(&s);
    }
}

// The layers belong to the frame, with its chosen settings. The pixels are the same as without
// layers.
static void layers_are_those_of_the_frame(void **state)
{
    (void)state;
    static const char *const scenes[] = {"materials", "mirror_sphere", "glass_sphere"};
    for (int i = 0; i < 3; i++) {
        stage s;
        glint_image image = {0}, with_layers = {0};
        glint_error_choice choice, same;
        open_stage(scenes[i], 240, 160, &s);
        render_within(&s, 0.02, &image, &choice);
        s.at.settings.aovs = GLINT_AOV_ALL;
        render_within(&s, 0.02, &with_layers, &same);
        assert_string_equal(choice.rung.options, same.rung.options);
        assert_int_equal(same.rung.settings.aovs, GLINT_AOV_ALL);
        glint_layers layers;
        assert_int_equal(glint_renderer_layers(s.at.renderer, &layers, NULL), GLINT_OK);
        test_frame own;
        test_render(&s.at.scene, s.at.environment, NULL, &same.rung.settings, &own);
        assert_int_equal(test_count_different(&with_layers, &own.image), 0);
        assert_int_equal(layers.count, own.layers.count);
        for (size_t k = 0; k < layers.count; k++) {
            assert_memory_equal(layers.channels[k].values, own.layers.channels[k].values,
                                sizeof(float) * 240 * 160);
        }
        glint_metrics off;
        assert_int_equal(glint_metrics_find(&image, &with_layers, NULL, &off, NULL), GLINT_OK);
        assert_true(off.relative_rmse < 1e-4); // layers use another kernel where depth 1 is proved
        glint_layers_free(&layers);
        test_frame_free(&own);
        glint_image_free(&image);
        glint_image_free(&with_layers);
        close_stage(&s);
    }
}

// Earlier frames must not change the result: parts of a sequence are the same on all machines.
static void check_independence(const char *scene, double bound, double coarse)
{
    stage a, b;
    glint_image image = {0}, again = {0}, other = {0};
    glint_error_choice choice, same, unused;
    open_stage(scene, 288, 162, &a);
    open_stage(scene, 288, 162, &b);
    render_within(&a, bound, &image, &choice);
    render_within(&b, 1e-4, &other, &unused);
    b.at.camera.eye.x += 0.1;
    render_within(&b, coarse, &other, &unused);
    b.at.camera.eye = a.at.camera.eye;
    render_within(&b, bound, &again, &same);
    assert_int_equal(test_count_different(&image, &again), 0);
    assert_string_equal(choice.rung.options, same.rung.options);
    assert_true(choice.error == same.error && choice.choosing_rays == same.choosing_rays);
    assert_string_not_equal(unused.rung.options, same.rung.options);
    glint_image_free(&image);
    glint_image_free(&again);
    glint_image_free(&other);
    close_stage(&a);
    close_stage(&b);
}

static void each_frame_is_judged_by_itself(void **state)
{
    (void)state;
    check_independence("materials", 0.01, 0.3);
    check_independence("facing_mirrors", 1, 5); // at depth 4, after a frame at depth 1
}

static void looser_bounds_cost_no_more(void **state)
{
    (void)state;
    stage s;
    open_stage("prism", 160, 90, &s);
    double weight = 0;
    for (int i = 0; i < 4; i++) {
        glint_image image = {0};
        glint_error_choice choice;
        render_within(&s, pow(0.1, 4 - i), &image, &choice);
        assert_true(choice.rung.settings.min_weight >= weight);
        weight = choice.rung.settings.min_weight;
        glint_image_free(&image);
    }
    close_stage(&s);
}

static bool stop_after(void *context, uint64_t done, uint64_t total)
{
    (void)done, (void)total;
    int *left = context;
    return (*left)-- > 0;
}

static void it_can_be_stopped_while_it_chooses(void **state)
{
    (void)state;
    stage s;
    open_stage("prism", 480, 270, &s);
    glint_error_bound asked;
    glint_error_bound_begin(&asked, 0.01, &s.at.settings);
    glint_error_bound_set_environment(&asked, &s.at.environment->radiance);
    for (int steps = 0; steps < 3; steps++) {
        int left = steps;
        const glint_progress progress = {stop_after, &left};
        glint_image image = {0};
        glint_frame_report report;
        glint_error_choice choice;
        const glint_frame_request request = {s.at.renderer, &s.at.camera, &progress, &image,
                                             &report};
        assert_int_equal(glint_error_bound_frame(&asked, &request, &choice, NULL),
                         GLINT_INTERRUPTED);
        assert_null(image.pixels);
    }
    close_stage(&s);
}

// The contrast of an environment. For the studio, the test sums over the texels itself.
static void the_contrast_is_the_environments(void **state)
{
    (void)state;
    const glint_cube *cube = &test_studio()->radiance;
    double weight = 0, sum[3] = {0}, squares = 0;
    for (int face = 0; face < 6; face++) {
        for (int j = 0; j < cube->edge; j++) {
            for (int i = 0; i < cube->edge; i++) {
                const double s = (2.0 * i + 1) / cube->edge - 1, t = (2.0 * j + 1) / cube->edge - 1;
                const double w = pow(1 + s * s + t * t, -1.5);
                const float *texel = glint_cube_texel(cube, face, i, j);
                weight += w;
                for (int c = 0; c < 3; c++) {
                    sum[c] += w * (double)texel[c];
                    squares += w * (double)texel[c] * (double)texel[c] / 3;
                }
            }
        }
    }
    double means = 0;
    for (int c = 0; c < 3; c++) {
        means += sum[c] / weight * sum[c] / weight / 3;
    }
    glint_error_bound bound;
    glint_error_bound_begin(&bound, 0.1, &glint_settings_default);
    glint_error_bound_set_environment(&bound, cube);
    const double expected = sqrt(squares / weight - means);
    assert_true(fabs(bound.contrast - expected) < 1e-9 * expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_are_kept),
        cmocka_unit_test(contrast_may_be_the_scenes_own),
        cmocka_unit_test(what_a_grid_cannot_see_is_reckoned_with),
        cmocka_unit_test(what_a_grid_may_miss_can_be_afforded),
        cmocka_unit_test(mirrors_that_show_mirrors_have_edges),
        cmocka_unit_test(what_lies_between_is_seen_of_the_frame),
        cmocka_unit_test(odd_light_gets_the_reference),
        cmocka_unit_test(frames_may_have_any_shape),
        cmocka_unit_test(layers_are_those_of_the_frame),
        cmocka_unit_test(each_frame_is_judged_by_itself),
        cmocka_unit_test(looser_bounds_cost_no_more),
        cmocka_unit_test(it_can_be_stopped_while_it_chooses),
        cmocka_unit_test(the_contrast_is_the_environments),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
