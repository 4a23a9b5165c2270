// Tests touching and overlapping solids against the oracle, which finds media by points instead of
// a stack. Covers any order of triangles, faces shared wholly or partly, one mesh or several.
#include "support/bodies.h"
#include "support/bridge.h"
#include "support/judged.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// Relative RMSE of a frame against the oracle.
static double error_of(const glint_scene *scene, const glint_settings *settings,
                       glint_feature feature)
{
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    test_frame frame;
    test_render(scene, &environment, NULL, settings, &frame);
    assert_true(feature == GLINT_FEATURE_INSIDE || frame.plan.features[feature].compiled);
    const double error = judged_overlaps(scene, &environment, settings, &frame);
    test_frame_free(&frame);
    glint_environment_free(&environment);
    return error;
}

// The oracle's rays start 2e-6 beside the surface that they leave, and continue at this distance
// from their path. So do glint's rays in single precision.
#define ALLOWED 1e-5

static const bodies kinds[] = {
    {.what = "two boxes of one glass",
     .of = {{{-0.6, -0.4, -0.4}, {0, 0.4, 0.4}, GLASS, 0, 0, false},
            {{0, -0.4, -0.4}, {0.6, 0.4, 0.4}, GLASS, 0, 0, false}}},
    {.what = "the same in one mesh, whose corners are welded",
     .of = {{{-0.6, -0.4, -0.4}, {0.1, 0.4, 0.4}, GLASS, 0, 1, false},
            {{0.1, -0.4, -0.4}, {0.6, 0.4, 0.4}, GLASS, 0, 1, false}}},
    {.what = "the same, divided differently",
     .of = {{{-0.6, -0.4, -0.4}, {0.1, 0.4, 0.4}, GLASS, 2, 1, false},
            {{0.1, -0.4, -0.4}, {0.6, 0.4, 0.4}, GLASS, 3, 1, false}}},
    {.what = "boxes of one glass that overlap",
     .of = {{{-0.6, -0.4, -0.4}, {0.2, 0.4, 0.4}, GLASS, 2, 0, false},
            {{-0.1, -0.3, -0.2}, {0.6, 0.5, 0.3}, GLASS, 3, 0, false}}},
    {.what = "water in glass, whose faces it shares",
     .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 2, 1, false},
            {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, GLASS, 2, 1, true},
            {{-0.5, -0.5, -0.5}, {0.5, 0.1, 0.5}, WATER, 3, 0, false}}},
    {.what = "water that reaches into its glass",
     .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 2, 1, false},
            {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, GLASS, 2, 1, true},
            {{-0.55, -0.55, -0.55}, {0.55, 0.1, 0.55}, WATER, 3, 0, false}}},
    {.what = "ice in water, half out of it",
     .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, WATER, 2, 0, false},
            {{-0.3, -0.2, -0.3}, {0.2, 0.4, 0.25}, ICE, 0, 0, false}}},
    {.what = "ice in water, half out of it, with edges at its level",
     .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, WATER, 3, 0, false},
            {{-0.3, -0.2, -0.3}, {0.2, 0.4, 0.25}, ICE, 2, 0, false}}},
    {.what = "ice whose top is in the water's",
     .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, WATER, 2, 0, false},
            {{-0.3, -0.2, -0.3}, {0.2, 0.1, 0.25}, ICE, 3, 0, false}}},
    {.what = "panes of glass with water between them",
     .of = {{{-0.6, -0.6, -0.1}, {0.6, 0.6, 0}, GLASS, 1, 0, false},
            {{-0.6, -0.6, 0}, {0.6, 0.6, 0.07}, WATER, 4, 0, false},
            {{-0.6, -0.6, 0.07}, {0.6, 0.6, 0.2}, GLASS, 3, 0, false}}},
    {.what = "a small stone on a block, another beside it",
     .of = {{{-0.6, -0.5, -0.5}, {0.6, 0, 0.5}, GLASS, 3, 0, false},
            {{-0.25, 0, -0.1}, {0.05, 0.3, 0.2}, ICE, 0, 0, false},
            {{0.05, 0, -0.2}, {0.4, 0.2, 0.15}, WATER, 2, 0, false}}},
    {.what = "ice in ice and water in both, at one corner",
     .of = {{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, GLASS, 0, 0, false},
            {{-0.5, -0.5, -0.5}, {0.3, 0.3, 0.3}, ICE, 2, 0, false},
            {{-0.5, -0.5, -0.5}, {0.1, 0.1, 0.1}, WATER, 3, 0, false}}},
    {.what = "water that the file ranks over its glass",
     .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 2, 1, false},
            {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, GLASS, 2, 1, true},
            {{-0.55, -0.55, -0.55}, {0.55, 0.1, 0.55}, WATER, 3, 0, false}},
     .priorities = {[WATER] = 1}},
    {.what = "ice that the file ranks under the water around it: it is not there",
     .of = {{{-0.6, -0.5, -0.6}, {0.6, 0.1, 0.6}, WATER, 2, 0, false},
            {{-0.3, -0.2, -0.3}, {0.2, 0, 0.25}, ICE, 0, 0, false}},
     .priorities = {[ICE] = -2, [WATER] = -1}},
    {.what = "a stone on metal, and held by some that reaches into it",
     .of = {{{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}, GLASS, 3, 0, false},
            {{-0.5, -0.6, -0.5}, {0.5, -0.3, 0.5}, METAL, 2, 0, false},
            {{0.2, -0.2, -0.1}, {0.5, 0.1, 0.1}, METAL, 0, 0, false}}},
    {.what = "water in glass on paint, in a lamp's light",
     .of = {{{-0.3, -0.3, -0.3}, {0.3, 0.3, 0.3}, GLASS, 2, 1, false},
            {{-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}, GLASS, 2, 1, true},
            {{-0.25, -0.25, -0.25}, {0.25, 0.1, 0.25}, WATER, 3, 0, false},
            {{-0.7, -0.5, -0.7}, {0.7, -0.3, 0.7}, PAINT, 0, 0, false}},
     .lamp = true},
    {.what = "water that reaches into its glass, and disperses light",
     .of = {{{-0.6, -0.6, -0.6}, {0.6, 0.6, 0.6}, GLASS, 2, 1, false},
            {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, GLASS, 2, 1, true},
            {{-0.55, -0.55, -0.55}, {0.55, 0.1, 0.55}, WATER, 3, 0, false}},
     .dispersion = 2},
};

static void media_are_what_points_say(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        for (int kind = 0; kind < 8; kind++) {
            glint_scene scene = bodies_scene(&kinds[i], kind & 4 ? 0.7 : 0, kind & 1);
            glint_settings settings = judged_frame(24, 18, 6);
            settings.precision = kind & 2 ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
            const double error = error_of(&scene, &settings, GLINT_FEATURE_OVERLAPS);
            print_message("%s, %s%s%s: %.7f\n", kinds[i].what, kind & 2 ? "double" : "float",
                          kind & 1 ? ", backwards" : "", kind & 4 ? ", turned" : "", error);
            glint_scene_free(&scene);
            assert_true(error <= ALLOWED);
        }
    }
}

// Places of eyes, and the medium around them.
typedef struct eye {
    const char *what;
    double at[3];
    bool orthographic;
    bodies bodies;
} eye;

// A block of glass with water in it and ice in the water; and a block of ice that touches the
// glass.
#define NESTED                                                                                     \
    {                                                                                              \
        .of = {                                                                                    \
            {{-0.6, -0.5, -0.5}, {0.6, 0.5, 0.5}, GLASS, 2, 0, false},                             \
            {{-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}, WATER, 3, 0, false},                             \
            {{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}, ICE, 0, 0, false},                               \
        }                                                                                          \
    }
#define ONE                                                                                        \
    {                                                                                              \
        .of = { {{-0.6, -0.5, -0.5}, {0.6, 0.5, 0.5}, GLASS, 2, 0, false} }                        \
    }
#define BESIDE                                                                                     \
    {                                                                                              \
        .of = {                                                                                    \
            {{-0.6, -0.5, -0.5}, {0, 0.5, 0.5}, GLASS, 2, 0, false},                               \
            {{0, -0.4, -0.4}, {0.5, 0.4, 0.4}, WATER, 3, 0, false},                                \
        }                                                                                          \
    }

static const eye eyes[] = {
    {"in the innermost of three solids", {0.05, -0.1, 0.02}, false, NESTED},
    {"in the middle one", {0.3, 0.05, 0.1}, false, NESTED},
    {"in the outermost", {0.05, 0.45, 0.1}, false, NESTED},
    {"between parallel rays that begin in all three", {0.05, 0.01, 0.02}, true, NESTED},
    {"on the innermost one's face", {0.2, 0.05, 0.1}, false, NESTED},
    {"on the outer face", {0.6, 0.1, 0.1}, false, NESTED},
    {"in a block", {0.1, 0.2, -0.1}, false, ONE},
    {"on a block's face", {0.6, 0.1, 0.1}, false, ONE},
    {"on its edge", {0.6, 0.5, 0.1}, false, ONE},
    {"on its corner", {0.6, 0.5, 0.5}, false, ONE},
    {"on the face between two blocks", {0, 0.1, 0.2}, false, BESIDE},
    {"on the edge of such a face", {0, 0.4, 0.1}, false, BESIDE},
};

static void eyes_begin_in_what_they_leave_first(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof eyes / sizeof *eyes; i++) {
        for (int kind = 0; kind < 4; kind++) {
            const double turn = kind & 2 ? 0.7 : 0;
            glint_scene scene = bodies_scene(&eyes[i].bodies, turn, false);
            glint_settings settings = judged_frame(24, 18, 6);
            settings.precision = kind & 1 ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
            bodies_look(&scene, eyes[i].at, turn, eyes[i].orthographic);
            const double error = error_of(&scene, &settings, GLINT_FEATURE_INSIDE);
            print_message("%s, %s%s: %.7f\n", eyes[i].what, kind & 1 ? "double" : "float",
                          kind & 2 ? ", turned" : "", error);
            glint_scene_free(&scene);
            assert_true(error <= ALLOWED);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(media_are_what_points_say),
        cmocka_unit_test(eyes_begin_in_what_they_leave_first),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
