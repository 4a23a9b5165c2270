// Tests new settings for an existing renderer: its frames must equal, bit for bit, the frames of a
// new renderer with these settings. Also tests the statistics for choosing settings.
#include "device/opencl.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

typedef struct variation {
    glint_precision precision;
    glint_texels texels;
    int depth;
    double min_weight;
    int grid_step;
    uint32_t aovs;
    int terms;
    bool truncation_squares;
} variation;

static const variation variations[] = {
    {.min_weight = 0.01, .truncation_squares = true},
    {.precision = GLINT_PRECISION_DOUBLE, .min_weight = 1e-4},
    {.texels = GLINT_TEXELS_FLOAT, .depth = 2, .min_weight = 0.01},
    {.precision = GLINT_PRECISION_DOUBLE,
     .texels = GLINT_TEXELS_HALF,
     .min_weight = 0.1,
     .grid_step = 3},
    {.depth = 1, .min_weight = 0.01, .aovs = GLINT_AOV_ALL},
    {.min_weight = 1e-5, .grid_step = 2, .terms = 2},
    {.min_weight = 0.01, .truncation_squares = true}, // again the first
    {.depth = 200, .min_weight = 1e-7},
};

enum { VARIATIONS = sizeof variations / sizeof *variations };

static glint_settings vary(const glint_settings *first, const variation *v)
{
    glint_settings s = *first;
    s.precision = v->precision;
    s.texels = v->texels;
    s.depth = v->depth;
    s.min_weight = v->min_weight;
    s.grid_step = v->grid_step;
    s.aovs = v->aovs;
    s.terms = v->terms;
    s.truncation_squares = v->truncation_squares;
    return s;
}

static void check_plan(const glint_plan *plan, const glint_plan *other)
{
    char options[2][GLINT_BUILD_OPTIONS_BYTES];
    glint_plan_build_options(plan, options[0]);
    glint_plan_build_options(other, options[1]);
    assert_string_equal(options[0], options[1]);
    assert_int_equal(plan->depth, other->depth);
    assert_int_equal(plan->depth_is_exact, other->depth_is_exact);
    assert_int_equal(plan->environment_bytes, other->environment_bytes);
    assert_string_equal(plan->texels_reason, other->texels_reason);
    assert_string_equal(plan->width_reason, other->width_reason);
}

// Both frames must contain the same requested results.
static void check_frame(test_stage *s, const glint_settings *settings)
{
    test_frame own;
    glint_image image = {0};
    glint_frame_report report;
    glint_layers layers = {0};
    test_render(&s->scene, test_studio(), NULL, settings, &own);
    assert_int_equal(
        glint_renderer_frame(&(glint_frame_request){s->renderer, &s->camera, NULL, &image, &report},
                             NULL),
        GLINT_OK);
    check_plan(glint_renderer_plan(s->renderer), &own.plan);
    assert_int_equal(test_count_different(&image, &own.image), 0);
    assert_memory_equal(&report.rays, &own.report.rays, sizeof report.rays);
    assert_memory_equal(&report.truncation, &own.report.truncation, sizeof report.truncation);
    const bool has_layers = settings->aovs != 0 || settings->terms > 0;
    assert_int_equal(glint_renderer_layers(s->renderer, &layers, NULL),
                     has_layers ? GLINT_OK : GLINT_USAGE);
    assert_int_equal(layers.count, own.layers.count);
    const size_t pixels = (size_t)image.width * (size_t)image.height;
    for (size_t i = 0; i < layers.count; i++) {
        assert_memory_equal(layers.channels[i].values, own.layers.channels[i].values,
                            pixels * sizeof(float));
    }
    glint_layers_free(&layers);
    glint_image_free(&image);
    test_frame_free(&own);
}

static void check_variations(const char *scene, size_t count)
{
    const glint_settings first = test_small_frame(0);
    test_stage s;
    test_stage_open(scene, &first, &s);
    for (size_t i = 0; i < count; i++) {
        const glint_settings settings = vary(&first, &variations[i]);
        assert_int_equal(glint_renderer_set_settings(s.renderer, &settings, NULL), GLINT_OK);
        check_frame(&s, &settings);
    }
    assert_int_equal(glint_renderer_set_settings(s.renderer, &first, NULL), GLINT_OK);
    check_frame(&s, &first);
    test_stage_close(&s);
}

static void frames_are_those_of_a_renderer_made_with_them(void **state)
{
    (void)state;
    check_variations("gallery", VARIATIONS);
    check_variations("mirror_sphere", VARIATIONS); // depth 1 is proved for eyes outside
    check_variations("lecture_example_2", 4);
}

// Settings that permit it, and only these, use the proofs about a scene.
static void proofs_are_for_all_settings(void **state)
{
    (void)state;
    const glint_settings automatic = test_small_frame(0), two = test_small_frame(2);
    glint_settings layers = automatic;
    layers.aovs = GLINT_AOV_ALL;
    test_stage s;
    test_stage_open("mirror_sphere", &layers, &s);
    check_frame(&s, &layers);
    assert_false(glint_renderer_plan(s.renderer)->depth_is_exact);
    assert_int_equal(glint_renderer_set_settings(s.renderer, &automatic, NULL), GLINT_OK);
    check_frame(&s, &automatic);
    assert_true(glint_renderer_plan(s.renderer)->depth_is_exact);
    test_stage_close(&s);
    assert_true(glint_settings_are_variation(&two, &automatic));
    assert_false(glint_settings_are_variation(&automatic, &two)); // nobody has searched for proofs
}

static void another_scene_or_environment_brings_the_first_settings_back(void **state)
{
    (void)state;
    const glint_settings first = test_small_frame(0);
    const glint_settings other = vary(&first, &variations[3]);
    test_stage s;
    test_stage_open("materials", &first, &s);
    assert_int_equal(glint_renderer_set_settings(s.renderer, &other, NULL), GLINT_OK);
    assert_int_equal(glint_renderer_prepare(s.renderer, &s.scene, NULL), GLINT_OK);
    check_frame(&s, &other);
    assert_int_equal(glint_renderer_set_prepared(s.renderer, &s.scene, NULL), GLINT_OK);
    check_frame(&s, &first);
    assert_int_equal(glint_renderer_set_settings(s.renderer, &other, NULL), GLINT_OK);
    assert_int_equal(glint_renderer_set_scene(s.renderer, &s.scene, NULL), GLINT_OK);
    check_frame(&s, &first);
    assert_int_equal(glint_renderer_set_settings(s.renderer, &other, NULL), GLINT_OK);
    assert_int_equal(glint_renderer_set_environment(s.renderer, test_studio(), NULL), GLINT_OK);
    check_frame(&s, &first);
    test_stage_close(&s);
}

// More plans than the kernel cache holds, with small and large frames in turns. The two plans
// between the others must not change.
static void there_may_be_any_number_of_them(void **state)
{
    (void)state;
    const glint_settings first = test_small_frame(0);
    glint_settings grid = first;
    grid.precision = GLINT_PRECISION_DOUBLE;
    grid.grid_step = 4;
    test_stage s;
    test_stage_open("facing_mirrors", &first, &s);
    for (int i = 0; i < 8; i++) {
        const variation other = {.precision = i & 1,
                                 .texels = i & 2 ? GLINT_TEXELS_HALF : GLINT_TEXELS_FLOAT,
                                 .depth = i & 4 ? 1 : 3,
                                 .min_weight = first.min_weight,
                                 .terms = 8 - i,
                                 .truncation_squares = i & 1};
        const glint_settings turns[] = {vary(&first, &other), first, grid};
        for (int j = 0; j < 3; j++) {
            assert_int_equal(glint_renderer_set_settings(s.renderer, &turns[j], NULL), GLINT_OK);
            check_frame(&s, &turns[j]);
        }
    }
    test_stage_close(&s);
}

static void bad_ones_are_refused_until_there_are_good_ones(void **state)
{
    (void)state;
    const glint_settings first = test_small_frame(0);
    test_stage s;
    test_stage_open("prism", &first, &s);
    glint_settings bad = first;
    bad.min_weight = -1;
    glint_image image = {0};
    glint_error error = {0};
    assert_int_equal(glint_renderer_set_settings(s.renderer, &bad, &error), GLINT_USAGE);
    assert_non_null(strstr(error.message, "--min-weight"));
    glint_error_free(&error);
    assert_int_equal(glint_renderer_frame(
                         &(glint_frame_request){s.renderer, &s.camera, NULL, &image, NULL}, NULL),
                     GLINT_USAGE);
    bad = first;
    bad.fresnel = GLINT_FRESNEL_NONE;
    assert_int_equal(glint_renderer_set_settings(s.renderer, &bad, &error), GLINT_USAGE);
    assert_non_null(strstr(error.message, "a renderer of their own"));
    glint_error_free(&error);
    assert_int_equal(glint_renderer_set_settings(s.renderer, &first, NULL), GLINT_OK);
    check_frame(&s, &first);
    test_stage_close(&s);
}

// The buffers of the new settings must also fit into the device's free memory.
static void what_the_device_cannot_hold_is_refused(void **state)
{
    (void)state;
    const glint_settings first = test_small_frame(0);
    glint_settings large = first;
    large.terms = GLINT_TERMS_MAX;
    test_stage s;
    test_stage_open("prism", &first, &s);
    const glint_device_bytes bytes = glint_renderer_device_bytes(s.renderer);
    struct glint_device *device = test_device();
    const uint64_t memory = device->capabilities.memory_bytes;
    device->capabilities.memory_bytes =
        bytes.scene + bytes.tree + bytes.environment + 2 * bytes.frame;
    glint_error error = {0};
    assert_int_equal(glint_renderer_set_settings(s.renderer, &first, &error), GLINT_OK);
    const glint_status status = glint_renderer_set_settings(s.renderer, &large, &error);
    device->capabilities.memory_bytes = memory;
    assert_int_equal(status, GLINT_DEVICE_LACKS);
    assert_non_null(strstr(error.message, "scene, environment and frame need"));
    glint_error_free(&error);
    assert_int_equal(glint_renderer_set_settings(s.renderer, &first, NULL), GLINT_OK);
    check_frame(&s, &first);
    test_stage_close(&s);
}

// Changes of settings and mended frames must not count shared uploads again.
static void uploads_do_not_add_up(void **state)
{
    (void)state;
    const glint_settings first = test_small_frame(0);
    glint_settings grid = first;
    grid.grid_step = 2;
    test_stage s;
    test_stage_open("prism", &first, &s);
    const double uploaded = glint_renderer_phases(s.renderer)->upload;
    for (int i = 0; i < 4; i++) {
        assert_int_equal(glint_renderer_set_settings(s.renderer, i & 1 ? &first : &grid, NULL),
                         GLINT_OK);
        assert_true(glint_renderer_phases(s.renderer)->upload == uploaded);
    }
    test_stage_close(&s);
}

// ---- Counters ----------------------------------------------------------------------------------

typedef struct truncation_case {
    const char *scene;
    int depth, samples_per_axis;
    double min_weight;
    bool is_zero; // the error is exactly zero
} truncation_case;

static const truncation_case truncations[] = {
    {"gallery", 3, 1, 1.0 / 64, false},    {"gallery", 2, 2, 0.1, false},
    {"mirror_sphere", 1, 1, 0, false},     {"mirror_sphere", 0, 1, 0, true}, // proved to be exact
    {"lecture_example_2", 2, 1, 0, false},
};

// The layer holds each pixel's truncated weight, added up the slowest way: one by one.
static double rms_of_layer(const test_frame *frame, const glint_settings *settings)
{
    const size_t pixels = (size_t)settings->width * (size_t)settings->height;
    double sum = 0;
    for (size_t i = 0; i < pixels; i++) {
        const double weight = (double)frame->layers.channels[0].values[i];
        sum += weight * weight;
    }
    return sqrt(sum / (double)pixels);
}

static void truncated_weight_is_counted_pixel_by_pixel(void **state)
{
    (void)state;
    static const int widths[] = {1, 8, 16};
    for (size_t i = 0; i < sizeof truncations / sizeof *truncations; i++) {
        const truncation_case *c = &truncations[i];
        glint_scene scene = {0};
        test_scene_load(c->scene, &scene);
        glint_settings settings = test_small_frame(c->depth);
        settings.samples_per_axis = c->samples_per_axis;
        settings.min_weight = c->min_weight;
        settings.truncation_squares = true;
        double rms[3];
        for (int w = 0; w < 3; w++) {
            test_frame frame;
            settings.kernel_width = widths[w];
            test_render(&scene, test_studio(), NULL, &settings, &frame);
            rms[w] = frame.report.truncation.rms;
            test_frame_free(&frame);
        }
        assert_true(rms[0] == rms[1] && rms[1] == rms[2]);
        settings.aovs = GLINT_AOV_BIT(GLINT_AOV_TRUNCATED);
        test_frame with_layer;
        test_render(&scene, test_studio(), NULL, &settings, &with_layer);
        const double expected = c->is_zero ? 0 : rms_of_layer(&with_layer, &settings);
        assert_true(c->is_zero || expected > 1e-3);
        // Float sums of up to some hundred weights, and 2^−37 of each square.
        assert_true(fabs(rms[0] - expected) <= 1e-5 * expected);
        test_frame_free(&with_layer);
        glint_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_those_of_a_renderer_made_with_them),
        cmocka_unit_test(proofs_are_for_all_settings),
        cmocka_unit_test(another_scene_or_environment_brings_the_first_settings_back),
        cmocka_unit_test(there_may_be_any_number_of_them),
        cmocka_unit_test(bad_ones_are_refused_until_there_are_good_ones),
        cmocka_unit_test(what_the_device_cannot_hold_is_refused),
        cmocka_unit_test(uploads_do_not_add_up),
        cmocka_unit_test(truncated_weight_is_counted_pixel_by_pixel),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
