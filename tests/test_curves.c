// Tests keyframes against closed forms.
#include "scene/gltf/curve.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void assert_close(const double *got, const double *expected, int count, double tolerance)
{
    for (int k = 0; k < count; k++) {
        if (!(fabs(got[k] - expected[k]) <= tolerance)) {
            fail_msg("[%d]: %.17g is not %.17g", k, got[k], expected[k]);
        }
    }
}

static void linear_and_step_hold_at_the_ends(void **state)
{
    (void)state;
    const double times[] = {0.5, 1.5, 3.5};
    const double values[] = {1, 2, 3, 5, -2, 3, 9, 0, 7};
    glint_curve curve = {GLINT_INTERPOLATION_LINEAR, false, 3, 3, times, values};
    static const double samples[][5] = {
        // time; LINEAR's value; STEP's first number
        {-1, 1, 2, 3, 1},       {0, 1, 2, 3, 1},         {0.5, 1, 2, 3, 1}, {1, 3, 0, 3, 1},
        {1.5, 5, -2, 3, 5},     {2.5, 7, -1, 5, 5},      {3.5, 9, 0, 7, 9}, {100, 9, 0, 7, 9},
        {INFINITY, 9, 0, 7, 9}, {-INFINITY, 1, 2, 3, 1}, {NAN, 1, 2, 3, 1},
    };
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        double value[3];
        curve.interpolation = GLINT_INTERPOLATION_LINEAR;
        glint_curve_sample(&curve, samples[i][0], value);
        assert_close(value, &samples[i][1], 3, 1e-15);
        curve.interpolation = GLINT_INTERPOLATION_STEP;
        glint_curve_sample(&curve, samples[i][0], value);
        assert_close(value, &samples[i][4], 1, 0);
    }
}

// Keys lie on the floats next to the times of frames; a third of them lie above. A step at frame n
// must come at frame n, not before.
static void steps_come_at_their_frames(void **state)
{
    (void)state;
    static const double rates[] = {12, 23.976, 24, 25, 29.97, 30, 48, 50, 60, 120};
    enum { KEYS = 2000 };
    static double times[KEYS], values[KEYS * 3];
    for (size_t r = 0; r < sizeof rates / sizeof *rates; r++) {
        for (int i = 0; i < KEYS; i++) {
            times[i] = (double)(float)(i / rates[r]);
            values[3 * i] = i;
        }
        const glint_curve curve = {GLINT_INTERPOLATION_STEP, false, 3, KEYS, times, values};
        for (int i = 0; i < KEYS; i++) {
            double value[3];
            glint_curve_sample(&curve, i / rates[r], value);
            assert_true(value[0] == i);
            glint_curve_sample(&curve, (i + 0.99) / rates[r], value);
            assert_true(value[0] == i);
        }
    }
}

// Hermite's spline is the only cubic with the given ends and slopes, so it must reproduce any
// cubic.
static void splines_give_cubics_back(void **state)
{
    (void)state;
    enum { KEYS = 4 };
    const double times[KEYS] = {0.25, 1, 1.5, 4};
    double values[KEYS * 9];
    for (int i = 0; i < KEYS; i++) {
        for (int k = 0; k < 3; k++) {
            const double t = times[i], a = k + 1;
            values[9 * i + 3 + k] = a * t * t * t - 2 * t * t + t - a;
            values[9 * i + k] = values[9 * i + 6 + k] = 3 * a * t * t - 4 * t + 1;
        }
    }
    const glint_curve curve = {GLINT_INTERPOLATION_CUBIC, false, 3, KEYS, times, values};
    for (int step = 0; step <= 375; step++) {
        const double t = 0.25 + 0.01 * step;
        double value[3], expected[3];
        glint_curve_sample(&curve, t, value);
        for (int k = 0; k < 3; k++) {
            const double a = k + 1;
            expected[k] = a * t * t * t - 2 * t * t + t - a;
        }
        assert_close(value, expected, 3, 1e-12 * 200); // values of up to 162
    }
}

static void quaternion_about(const double axis[3], double angle, double q[4])
{
    for (int k = 0; k < 3; k++) {
        q[k] = axis[k] * sin(angle / 2);
    }
    q[3] = cos(angle / 2);
}

// A rotation at a steady rate must turn by the share of its angle. This holds for keys that are not
// unit, have opposite signs, nearly coincide, or are half a turn apart.
static void rotations_take_the_shorter_way_at_a_steady_rate(void **state)
{
    (void)state;
    const double axis[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3}, times[] = {0, 1};
    static const double angles[] = {0, 1e-300, 1e-12, 1e-4, 1, 2, 3.1, 3.14159};
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            double values[8];
            quaternion_about(axis, 0.7, values);
            quaternion_about(axis, 0.7 + angles[i], values + 4);
            for (int k = 0; k < 4; k++) {
                values[k] *= 3;
                values[4 + k] *= sign * 0.5;
            }
            const glint_curve curve = {GLINT_INTERPOLATION_LINEAR, true, 4, 2, times, values};
            for (int eighth = 0; eighth <= 8; eighth++) {
                const double share = eighth / 8.0;
                double got[4], expected[4];
                glint_curve_sample(&curve, share, got);
                quaternion_about(axis, 0.7 + share * angles[i], expected);
                const double same = got[3] * expected[3] < 0 ? -1 : 1;
                for (int k = 0; k < 4; k++) {
                    expected[k] *= same;
                }
                assert_close(got, expected, 4, 1e-15 * 4);
            }
        }
    }
}

static void splines_of_rotations_are_unit(void **state)
{
    (void)state;
    const double times[] = {0, 2};
    // Opposite quaternions: half-way the spline passes through 0, where no rotation exists.
    const double values[] = {0, 0, 0, 0, 0, 0, 0, 1,  0, 0, 0, 0,
                             0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0};
    const glint_curve curve = {GLINT_INTERPOLATION_CUBIC, true, 4, 2, times, values};
    for (int step = 0; step <= 16; step++) {
        double q[4];
        glint_curve_sample(&curve, step / 8.0, q);
        assert_close(&(double){q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]}, &(double){1},
                     1, 1e-15);
    }
}

static void what_never_changes_does_not_move(void **state)
{
    (void)state;
    const double times[] = {0, 1}, still[] = {1, 2, 3, 1, 2, 3}, moving[] = {1, 2, 3, 1, 2, 4};
    const double resting[18] = {0, 0, 0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 0};
    const double swinging[18] = {0, 0, 0, 1, 2, 3, 1, 0, 0, 0, 0, 0, 1, 2, 3, 0, 0, 0};
    assert_false(
        glint_curve_moves(&(glint_curve){GLINT_INTERPOLATION_LINEAR, false, 3, 2, times, still}));
    assert_false(
        glint_curve_moves(&(glint_curve){GLINT_INTERPOLATION_LINEAR, false, 3, 1, times, moving}));
    assert_true(
        glint_curve_moves(&(glint_curve){GLINT_INTERPOLATION_STEP, false, 3, 2, times, moving}));
    assert_false(
        glint_curve_moves(&(glint_curve){GLINT_INTERPOLATION_CUBIC, false, 3, 2, times, resting}));
    assert_true(
        glint_curve_moves(&(glint_curve){GLINT_INTERPOLATION_CUBIC, false, 3, 2, times, swinging}));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_and_step_hold_at_the_ends),
        cmocka_unit_test(steps_come_at_their_frames),
        cmocka_unit_test(splines_give_cubics_back),
        cmocka_unit_test(rotations_take_the_shorter_way_at_a_steady_rate),
        cmocka_unit_test(splines_of_rotations_are_unit),
        cmocka_unit_test(what_never_changes_does_not_move),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
