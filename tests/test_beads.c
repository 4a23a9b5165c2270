// Tests beads of a tenth of a millimetre on a plain of ten kilometres, in single precision. The
// oracle judges the same beads on a small plain, whose far corners cost it no digits: no path gets
// beyond it, but for a strip at the horizon.
#include "selftest/shapes.h"
#include "support/bridge.h"
#include "support/judged.h"
#include "support/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define RADIUS 5e-5
#define LARGE 5000.0 // half of the width of the plain
#define SMALL                                                                                      \
    0.05 // the same for the oracle, which looks at points 2e-5 of coordinates off surfaces

// As in test_overlaps.c: the oracle's rays start 2e-6 beside the surface that they leave.
#define ALLOWED 1e-5

typedef struct bead {
    const char *what;
    shape_material bead, plain;
    bool is_ball;
    double rise;     // height of the bead above the plain, in radii
    double place[2]; // x and z, metres
    double eye[3];   // from the bead's middle, in radii
    bool orthographic;
} bead;

#define ABOVE                                                                                      \
    {                                                                                              \
        2.5, 2, 6                                                                                  \
    }
#define BESIDE                                                                                     \
    {                                                                                              \
        4.5, 0.3, 3                                                                                \
    }
#define OVER                                                                                       \
    {                                                                                              \
        0.4, 7, 0.9                                                                                \
    }
#define OFF                                                                                        \
    {                                                                                              \
        2345.678, -1789.123                                                                        \
    }

static const bead beads[] = {
    {"paint in the middle", MATERIAL_PAINT, MATERIAL_MIRROR, false, 0, {0, 0}, ABOVE, false},
    {"paint", MATERIAL_PAINT, MATERIAL_MIRROR, false, 0, OFF, ABOVE, false},
    {"paint, from beside", MATERIAL_PAINT, MATERIAL_TINTED, false, 0, OFF, BESIDE, false},
    {"paint, from over it", MATERIAL_TINTED, MATERIAL_PAINT, false, 0, OFF, OVER, false},
    {"paint, by parallel rays", MATERIAL_PAINT, MATERIAL_MIRROR, false, 0, OFF, ABOVE, true},
    {"paint, half in the plain", MATERIAL_PAINT, MATERIAL_MIRROR, false, -1, OFF, ABOVE, false},
    {"paint that hovers", MATERIAL_PAINT, MATERIAL_MIRROR, false, 0.02, OFF, ABOVE, false},
    {"a mirror ball", MATERIAL_MIRROR, MATERIAL_PAINT, true, 0, OFF, ABOVE, false},
    {"a mirror ball from beside", MATERIAL_TINTED, MATERIAL_PAINT, true, 0, OFF, BESIDE, false},
    {"glass in the middle", MATERIAL_GLASS, MATERIAL_PAINT, false, 0, {0, 0}, ABOVE, false},
    {"glass", MATERIAL_GLASS, MATERIAL_PAINT, false, 0, OFF, ABOVE, false},
    {"glass from beside", MATERIAL_GLASS, MATERIAL_PAINT, false, 0, OFF, BESIDE, false},
    {"glass that hovers", MATERIAL_GLASS, MATERIAL_PAINT, false, 0.02, OFF, ABOVE, false},
    {"glass, half in the plain", MATERIAL_GLASS, MATERIAL_PAINT, false, -1, OFF, ABOVE, false},
    {"glass, by parallel rays", MATERIAL_GLASS, MATERIAL_PAINT, false, 0, OFF, ABOVE, true},
};

// Makes the scene. The world is in metres, with the plain at the height 0.
static glint_scene scene_of(const bead *b, double half, double unit)
{
    const double c[3] = {b->place[0], RADIUS * (1 + b->rise), b->place[1]};
    double plain[4][3];
    double low[3];
    double high[3];
    double center[3];
    for (int k = 0; k < 3; k++) {
        low[k] = (c[k] - RADIUS) / unit;
        high[k] = (c[k] + RADIUS) / unit;
        center[k] = c[k] / unit;
    }
    for (int i = 0; i < 4; i++) {
        plain[i][0] = (i == 1 || i == 2 ? half : -half) / unit;
        plain[i][1] = 0;
        plain[i][2] = (i < 2 ? half : -half) / unit;
    }
    shape s = shape_begin();
    if (b->is_ball) {
        shape_add_ball(&s, &(shape_ball){center, RADIUS / unit, 3, b->bead, true, NULL});
    } else {
        shape_add_box(&s, &(shape_box){low, high, 2, b->bead, false});
    }
    shape_add_quad(&s, (const double(*)[3])plain, b->plain);
    glint_scene scene;
    assert_int_equal(shape_end_with_parts(&s, unit, &scene, NULL, NULL), GLINT_OK);
    return scene;
}

static glint_camera camera_of(const bead *b)
{
    const double c[3] = {b->place[0], RADIUS * (1 + b->rise), b->place[1]};
    const double eye[3] = {c[0] + RADIUS * b->eye[0], c[1] + RADIUS * b->eye[1],
                           c[2] + RADIUS * b->eye[2]};
    return shape_camera(eye, c, b->orthographic ? 0 : 0.7, 2 * RADIUS);
}

static void render_frame(const bead *b, const glint_environment *environment,
                         const glint_settings *settings, test_frame *frame)
{
    glint_scene scene = scene_of(b, LARGE, 8192);
    glint_camera camera = camera_of(b);
    scene.cameras = &camera;
    scene.camera_count = 1;
    test_render(&scene, environment, NULL, settings, frame);
    assert_true(frame->plan.features[GLINT_FEATURE_LOCAL_ORIGINS].compiled);
    scene.cameras = NULL;
    scene.camera_count = 0;
    glint_scene_free(&scene);
}

// The relative RMSE of a frame beside the oracle, for which the bead is in the middle.
static double error_of(const bead *b, const glint_environment *environment,
                       const glint_settings *settings, const test_frame *frame)
{
    bead moved = *b;
    moved.place[0] = moved.place[1] = 0;
    glint_scene scene = scene_of(&moved, SMALL, 0x1p-4);
    glint_camera camera = camera_of(&moved);
    scene.cameras = &camera;
    scene.camera_count = 1;
    const double error = judged_overlaps(&scene, environment, settings, frame);
    scene.cameras = NULL;
    scene.camera_count = 0;
    glint_scene_free(&scene);
    return error;
}

static void beads_look_as_on_a_small_plain(void **state)
{
    (void)state;
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof beads / sizeof *beads; i++) {
        for (int precision = 0; precision < 2; precision++) {
            glint_settings settings = judged_frame(40, 30, 6);
            settings.roughness = GLINT_ROUGHNESS_SMOOTH;
            settings.precision = precision ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
            test_frame frame;
            render_frame(&beads[i], &environment, &settings, &frame);
            const double error = error_of(&beads[i], &environment, &settings, &frame);
            print_message("%s, %s: %.7f\n", beads[i].what, precision ? "double" : "float", error);
            assert_true(error <= ALLOWED);
            test_frame_free(&frame);
        }
    }
    glint_environment_free(&environment);
}

// Packets of every width find the same depths on the plain, bit for bit.
static void every_width_gives_the_same_bits(void **state)
{
    (void)state;
    glint_environment environment;
    bridge_direction_environment(16, &environment);
    for (size_t i = 0; i < sizeof beads / sizeof *beads; i += 2) {
        glint_settings settings = judged_frame(40, 30, 6);
        settings.roughness = GLINT_ROUGHNESS_SMOOTH;
        settings.kernel_width = 1;
        test_frame one;
        render_frame(&beads[i], &environment, &settings, &one);
        for (int width = 8; width <= 16; width *= 2) {
            settings.kernel_width = width;
            test_frame frame;
            render_frame(&beads[i], &environment, &settings, &frame);
            assert_int_equal(test_count_different(&frame.image, &one.image), 0);
            test_frame_free(&frame);
        }
        test_frame_free(&one);
    }
    glint_environment_free(&environment);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beads_look_as_on_a_small_plain),
        cmocka_unit_test(every_width_gives_the_same_bits),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
