// Tests the device against the oracle: fifteen scenes of scenes/, at depth 1, 2 and 8.
//
// Single precision may decide otherwise than double, for a ray within rounding of an edge, of the
// critical angle or of the least weight. The oracle's margins report such decisions. These pixels
// may flip, but rarely: at most 0.2% of pixels at depth 1 and 1% at depth 8 may differ by more than
// 0.001. The same holds near places where a texture jumps between texels or alpha decides. All
// other pixels must agree.
#include "environment/irradiance.h"
#include "support/bridge.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define TOLERANCE 1e-3

// The error of a path grows at each surface with its curvature. 1e-4 is about 10³ rounding errors,
// the effect of a few bounces on spheres on one rounding error.
#define FLOAT_MARGIN 1e-4

typedef struct agreement_bounds {
    int edge;                 // edge of the environment's cube
    double margin, tolerance; // see near_a_decision; for a radiance between 0 and 1
    // True: the oracle uses the device's irradiance map and texture levels. False: it computes
    // both.
    bool stored;
} agreement_bounds;

typedef struct agreement {
    size_t pixels, different, unexplained, nonfinite;
    double largest, squares; // difference of pixels within the margins; sum of all squares
} agreement;

static bool near_a_decision(const oracle_report *report, double margin)
{
    return report->edge < margin || report->critical < margin || report->threshold < margin ||
           report->jump < margin;
}

// Within this distance of a tie between two faces of the cube, a look-up may use either face.
// Distances are in components of the direction. The interpolations of 0.5 + 0.5 d differ by at most
// 2 (2/N)²/8 · 0.5.
#define TIE 1e-9
#define TIE_JUMP(edge) (0.5 / ((double)(edge) * (edge)))

static agreement compare(const bridge *b, const oracle_view *view, const test_frame *frame,
                         const agreement_bounds *bounds)
{
    agreement a = {0};
    for (int y = 0; y < view->height; y++) {
        for (int x = 0; x < view->width; x++) {
            const int pixel[2] = {x, y};
            double rgba[4];
            oracle_report report;
            oracle_pixel(bridge_scene(b), view, pixel, rgba, &report);
            const double *got = frame->exact + 4 * ((size_t)y * (size_t)view->width + (size_t)x);
            double difference = 0;
            for (int k = 0; k < 4; k++) {
                a.nonfinite += isfinite(got[k]) ? 0 : 1;
                difference = fmax(difference, fabs(got[k] - rgba[k]));
            }
            const bool tied = bridge_take_tie(b) < TIE;
            const double allowed =
                tied ? fmax(bounds->tolerance, TIE_JUMP(bounds->edge)) : bounds->tolerance;
            a.pixels++;
            a.squares += difference * difference;
            a.different += difference <= bounds->tolerance ? 0 : 1;
            if (!near_a_decision(&report, bounds->margin)) {
                a.largest = tied ? a.largest : fmax(a.largest, difference);
                a.unexplained += difference <= allowed ? 0 : 1;
            }
        }
    }
    return a;
}

static agreement render_and_compare(const char *name, const glint_settings *settings,
                                    const agreement_bounds *bounds)
{
    glint_scene scene = {0};
    test_scene_load(name, &scene);
    glint_environment environment;
    bridge_direction_environment(bounds->edge, &environment);
    test_frame frame;
    test_render(&scene, &environment, NULL, settings, &frame);
    bridge *b = bridge_create(&scene, &environment);
    glint_cube irradiance = {0};
    // Use the stored irradiance map, or the textures of the file.
    if (bounds->stored) {
        assert_int_equal(
            glint_irradiance_map(&environment.radiance, GLINT_IRRADIANCE_EDGE, &irradiance, NULL),
            GLINT_OK);
        bridge_use_irradiance_map(b, &irradiance);
    } else if (scene.textures != NULL) {
        bridge_read_textures(b, &scene);
    }
    glint_camera camera;
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
    const oracle_view view = bridge_view(&camera, settings);
    const agreement a = compare(b, &view, &frame, bounds);
    print_message("%-20s %s depth %d: %zu of %zu pixels differ by more than %g, largest %.2g where "
                  "no decision is near, RMS of all %.2g\n",
                  name, settings->precision == GLINT_PRECISION_DOUBLE ? "double" : "float",
                  settings->depth, a.different, a.pixels, bounds->tolerance, a.largest,
                  sqrt(a.squares / (double)a.pixels));
    assert_int_equal(a.nonfinite, 0);
    assert_int_equal(a.unexplained, 0);
    bridge_free(b);
    glint_cube_free(&irradiance);
    test_frame_free(&frame);
    glint_environment_free(&environment);
    glint_scene_free(&scene);
    return a;
}

static const char *const scene_names[] = {
    "mirror_sphere",     "glass_sphere",   "glass_slab", "prism",        "nested_glass",
    "thin_wall",         "absorption_box", "materials",  "orthographic", "facing_mirrors",
    "lecture_example_2", "axes",           "gallery",    "textures",     "lights",
};
#define SCENE_COUNT (sizeof scene_names / sizeof *scene_names)

static glint_settings small_frame(int depth)
{
    glint_settings settings = glint_settings_default;
    settings.width = 64;
    settings.height = 48;
    settings.depth = depth;
    settings.texels = GLINT_TEXELS_FLOAT;        // the oracle's texels
    settings.roughness = GLINT_ROUGHNESS_SMOOTH; // test_rough.c tests rough surfaces
    return settings;
}

static void check_depth(int depth, glint_fresnel fresnel, double allowed)
{
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        glint_settings settings = small_frame(depth);
        settings.fresnel = fresnel;
        const agreement_bounds limits = {64, FLOAT_MARGIN, TOLERANCE, false};
        agreement a = render_and_compare(scene_names[i], &settings, &limits);
        assert_true((double)a.different <= allowed * (double)a.pixels);
    }
}

static void at_depth_1_the_device_agrees_with_the_oracle(void **state)
{
    (void)state;
    check_depth(1, GLINT_FRESNEL_EXACT, 0.002);
}

static void at_depth_2_the_device_agrees_with_the_oracle(void **state)
{
    (void)state;
    check_depth(2, GLINT_FRESNEL_EXACT, 0.01);
}

static void at_depth_8_the_device_agrees_with_the_oracle(void **state)
{
    (void)state;
    check_depth(8, GLINT_FRESNEL_EXACT, 0.01);
}

static void without_fresnel_the_device_agrees_with_the_oracle(void **state)
{
    (void)state;
    check_depth(3, GLINT_FRESNEL_NONE, 0.01);
}

// Double precision leaves only rounding, if the oracle also uses the stored irradiance map and
// texels. All pixels without a near decision agree to 10⁻⁹. Where a look-up ties between two faces
// of the cube, the jump between the faces is added. A decision is near if the oracle's margin is
// below 10⁻⁹. This is millions of rounding errors, the effect of eight curved surfaces on one. Six
// pixels of a frame may be near a decision.
static void in_double_precision_only_rounding_is_left(void **state)
{
    (void)state;
    for (size_t i = 0; i < SCENE_COUNT; i++) {
        glint_settings settings = small_frame(8);
        settings.precision = GLINT_PRECISION_DOUBLE;
        const agreement_bounds limits = {64, 1e-9, 1e-9, true};
        agreement a = render_and_compare(scene_names[i], &settings, &limits);
        assert_true((double)a.different <= 0.002 * (double)a.pixels);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_depth_1_the_device_agrees_with_the_oracle),
        cmocka_unit_test(at_depth_2_the_device_agrees_with_the_oracle),
        cmocka_unit_test(at_depth_8_the_device_agrees_with_the_oracle),
        cmocka_unit_test(without_fresnel_the_device_agrees_with_the_oracle),
        cmocka_unit_test(in_double_precision_only_rounding_is_left),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
