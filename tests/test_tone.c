// Tests tone curves against the published formulas in double precision.
#include "image/image_io.h"
#include "image/tone.h"
#include "support/scratch.h"
#include "support/srgb.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// Values around every bend of both curves, and far beyond.
static const float values[] = {0,       1e-30f, 1e-6f, 1.8e-4f, 0.02f,  0.04f,  0.08f,
                               0.0801f, 0.18f,  0.5f,  0.8f,    0.801f, 1.0f,   1.5f,
                               4.0f,    16.3f,  1e3f,  1e9f,    1e30f,  FLT_MAX};
#define VALUES (int)(sizeof values / sizeof values[0])

// ---- The judges --------------------------------------------------------------------------------

// "PBR Neutral Specification", github.com/KhronosGroup/ToneMapping, PBR_Neutral/README.md.
static void neutral(const double c_in[3], double c_out[3])
{
    const double F90 = 0.04, Ks = 0.8 - F90, Kd = 0.15;
    const double x = fmin(c_in[0], fmin(c_in[1], c_in[2]));
    const double f = x <= 2 * F90 ? x - x * x / (4 * F90) : F90;
    const double p = fmax(c_in[0] - f, fmax(c_in[1] - f, c_in[2] - f));
    const double pn = 1 - (1 - Ks) * (1 - Ks) / (p + 1 - 2 * Ks);
    const double g = 1 / (Kd * (p - pn) + 1);
    for (int c = 0; c < 3; c++) {
        c_out[c] = p <= Ks ? c_in[c] - f : (c_in[c] - f) * (pn / p) * g + pn * (1 - g);
    }
}

// AgXToneMapping of three.js, with matrices by columns.
static void times(const double columns[9], const double v[3], double product[3])
{
    for (int row = 0; row < 3; row++) {
        product[row] = columns[row] * v[0] + columns[3 + row] * v[1] + columns[6 + row] * v[2];
    }
}

static void agx(const double c_in[3], double c_out[3])
{
    static const double to_2020[9] = {0.6274, 0.0691, 0.0164, 0.3293, 0.9195,
                                      0.0880, 0.0433, 0.0113, 0.8956};
    static const double from_2020[9] = {1.6605,  -0.1246, -0.0182, -0.5876, 1.1329,
                                        -0.1006, -0.0728, -0.0083, 1.1187};
    static const double in[9] = {0.856627153315983,  0.137318972929847, 0.11189821299995,
                                 0.0951212405381588, 0.761241990602591, 0.0767994186031903,
                                 0.0482516061458583, 0.101439036467562, 0.811302368396859};
    static const double out[9] = {
        1.1271005818144368,    -0.1413297634984383,   -0.14132976349843826,
        -0.11060664309660323,  1.157823702216272,     -0.11060664309660294,
        -0.016493938717834573, -0.016493938717834257, 1.2519364065950405};
    double a[3], b[3];
    times(to_2020, c_in, a);
    times(in, a, b);
    for (int c = 0; c < 3; c++) {
        double x = (log2(fmax(b[c], 1e-10)) + 12.47393) / (4.026069 + 12.47393);
        x = x < 0 ? 0 : x > 1 ? 1 : x;
        a[c] = 15.5 * pow(x, 6) - 40.14 * pow(x, 5) + 31.96 * pow(x, 4) - 6.868 * pow(x, 3) +
               0.4298 * x * x + 0.1191 * x - 0.00232;
    }
    times(out, a, b);
    for (int c = 0; c < 3; c++) {
        a[c] = pow(fmax(b[c], 0), 2.2);
    }
    times(from_2020, a, b);
    for (int c = 0; c < 3; c++) {
        c_out[c] = fmin(fmax(b[c], 0), 1);
    }
}

typedef void curve_function(const double c_in[3], double c_out[3]);

// Neutral: the rounding of the result to float. AgX: log2 and pow are floats of 24 bits. The last
// bit of the logarithm is 2⁻²¹ at its largest, and the curves scale it by at most 0.6. The last bit
// of pow is 2⁻²⁵. Rec. 709 scales both by at most 3.3.
static const struct {
    glint_tone tone;
    curve_function *judge;
    double tolerance;
} curves[] = {{GLINT_TONE_PBR_NEUTRAL, neutral, 1e-7}, {GLINT_TONE_AGX, agx, 1.2e-6}};
#define CURVES (sizeof curves / sizeof curves[0])

// ---- The curves --------------------------------------------------------------------------------

static void the_curves_are_the_published_ones(void **state)
{
    (void)state;
    for (size_t k = 0; k < CURVES; k++) {
        for (int i = 0; i < VALUES * VALUES * VALUES; i++) {
            float color[3] = {values[i % VALUES], values[i / VALUES % VALUES],
                              values[i / VALUES / VALUES]};
            const double before[3] = {(double)color[0], (double)color[1], (double)color[2]};
            double wanted[3];
            curves[k].judge(before, wanted);
            glint_tone_map(curves[k].tone, color);
            for (int c = 0; c < 3; c++) {
                if (!(fabs((double)color[c] - wanted[c]) <= curves[k].tolerance)) {
                    fail_msg("%s of %g %g %g: channel %d is %.9g, not %.9g",
                             glint_tone_names[curves[k].tone], before[0], before[1], before[2], c,
                             (double)color[c], wanted[c]);
                }
                assert_true(color[c] >= 0 && color[c] <= 1);
            }
        }
    }
}

static void none_keeps_every_bit(void **state)
{
    (void)state;
    const float before[3] = {NAN, -1, INFINITY};
    float color[3];
    memcpy(color, before, sizeof color);
    glint_tone_map(GLINT_TONE_NONE, color);
    assert_memory_equal(color, before, sizeof color);
}

static void what_is_no_light_is_black_or_as_bright_as_can_be(void **state)
{
    (void)state;
    static const struct {
        float value, is;
    } cases[] = {{NAN, 0}, {-NAN, 0}, {-1e-30f, 0}, {-5, 0}, {-INFINITY, 0}, {INFINITY, FLT_MAX}};
    for (size_t k = 0; k < CURVES; k++) {
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
            float odd[3] = {cases[i].value, 0.5f, cases[i].value};
            float plain[3] = {cases[i].is, 0.5f, cases[i].is};
            glint_tone_map(curves[k].tone, odd);
            glint_tone_map(curves[k].tone, plain);
            assert_memory_equal(odd, plain, sizeof odd);
        }
    }
}

static void black_is_black_and_white_has_room_above(void **state)
{
    (void)state;
    for (size_t k = 0; k < CURVES; k++) {
        float black[3] = {0, 0, 0}, white[3] = {1, 1, 1};
        glint_tone_map(curves[k].tone, black);
        glint_tone_map(curves[k].tone, white);
        for (int c = 0; c < 3; c++) {
            assert_true(black[c] == 0);
            assert_true(white[c] > 0.5f && white[c] < 0.9f);
        }
    }
    // By hand: p = 0.96, p_n = 1 − 0.24²/0.44.
    float white[3] = {1, 1, 1};
    glint_tone_map(GLINT_TONE_PBR_NEUTRAL, white);
    assert_true(fabs((double)white[0] - 0.869090909) < 1e-6);
}

static void more_light_is_never_darker(void **state)
{
    (void)state;
    static const float colors[][3] = {{1, 1, 1}, {1, 0.2f, 0.05f}, {0.1f, 0.3f, 1}};
    for (size_t k = 0; k < CURVES; k++) {
        for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++) {
            double brightest = 0;
            for (int step = -1400; step < 4000; step++) { // hundredths of stops
                float color[3];
                for (int c = 0; c < 3; c++) {
                    color[c] = colors[i][c] * (float)exp2(step / 100.0);
                }
                glint_tone_map(curves[k].tone, color);
                const double luminance = 0.2126 * (double)color[0] + 0.7152 * (double)color[1] +
                                         0.0722 * (double)color[2];
                assert_true(luminance >= brightest - curves[k].tolerance);
                brightest = fmax(luminance, brightest);
            }
        }
    }
}

static void neutral_keeps_base_colours_and_hues(void **state)
{
    (void)state;
    for (int i = 0; i < 9 * 9 * 9; i++) {
        const int red = i % 9, green = i / 9 % 9, blue = i / 81;
        const double before[3] = {0.08 + 0.09 * red, 0.08 + 0.09 * green, 0.08 + 0.09 * blue};
        // Between 0.08 and 0.8 the curve only subtracts the reflection's F90.
        float color[3] = {(float)before[0], (float)before[1], (float)before[2]};
        glint_tone_map(GLINT_TONE_PBR_NEUTRAL, color);
        for (int c = 0; c < 3; c++) {
            assert_true(fabs((double)color[c] - (before[c] - 0.04)) < 2e-7);
        }
        // Beyond 0.8 the colour stays in the plane through the white axis.
        float bright[3] = {(float)(5 * before[0]), (float)(5 * before[1]), (float)(5 * before[2])};
        glint_tone_map(GLINT_TONE_PBR_NEUTRAL, bright);
        const double cross = (double)(bright[0] - bright[1]) * (before[2] - before[1]) -
                             (double)(bright[2] - bright[1]) * (before[0] - before[1]);
        assert_true(fabs(cross) < 1e-6);
    }
}

static void agx_keeps_grey(void **state)
{
    (void)state;
    for (int i = 0; i < VALUES; i++) {
        float color[3] = {values[i], values[i], values[i]};
        glint_tone_map(GLINT_TONE_AGX, color);
        // The published matrices have four digits.
        assert_true(fabs((double)(color[0] - color[1])) < 4e-4 &&
                    fabs((double)(color[2] - color[1])) < 4e-4);
    }
}

// ---- In files ----------------------------------------------------------------------------------

static void judge_pixel(curve_function *judge, const float *linear, double scale, const float *read)
{
    const double before[3] = {(double)linear[0] * scale, (double)linear[1] * scale,
                              (double)linear[2] * scale};
    double wanted[3];
    judge(before, wanted);
    for (int c = 0; c < 3; c++) {
        assert_true(255 * fabs(srgb_from_linear(wanted[c]) - srgb_from_linear((double)read[c])) <
                    0.51);
    }
}

static void files_are_mapped_after_exposure_and_without_alpha(void **state)
{
    (void)state;
    float pixels[4][4] = {
        {0.9f, 0.4f, 0.1f, 1}, {0.5f, 0.6f, 0.02f, 0.25f}, {7, 3, 1, 1}, {0.3f, 0.3f, 0.3f, 0.5f}};
    const glint_image image = {4, 1, 4, pixels[0]};
    for (size_t k = 0; k < CURVES; k++) {
        const glint_write_options options = {.exposure = 1, .tone = curves[k].tone};
        glint_image png = {0}, exr = {0};
        assert_int_equal(glint_image_write(scratch_path("a.png"), &image, &options, NULL), 0);
        assert_int_equal(glint_image_write(scratch_path("a.exr"), &image, &options, NULL), 0);
        assert_int_equal(glint_image_read(scratch_path("a.png"), &png, NULL, NULL), GLINT_OK);
        assert_int_equal(glint_image_read(scratch_path("a.exr"), &exr, NULL, NULL), GLINT_OK);
        for (int p = 0; p < 4; p++) {
            const float stored_alpha = png.pixels[4 * p + 3];
            float color[3];
            for (int c = 0; c < 3; c++) {
                color[c] = png.pixels[4 * p + c] / stored_alpha;
                assert_true(fabsf(exr.pixels[4 * p + c] - pixels[p][c]) <= pixels[p][c] / 2048);
            }
            judge_pixel(curves[k].judge, pixels[p], 2 / (double)pixels[p][3], color);
        }
        glint_image_free(&png);
        glint_image_free(&exr);
    }
}

static void grey_files_are_mapped_as_grey(void **state)
{
    (void)state;
    float pixels[3] = {0.18f, 1, 30};
    const glint_image image = {3, 1, 1, pixels};
    for (size_t k = 0; k < CURVES; k++) {
        const glint_write_options options = {.tone = curves[k].tone};
        glint_image read = {0};
        assert_int_equal(glint_image_write(scratch_path("a.tif"), &image, &options, NULL), 0);
        assert_int_equal(glint_image_read(scratch_path("a.tif"), &read, NULL, NULL), GLINT_OK);
        assert_int_equal(read.channels, 1);
        for (int p = 0; p < 3; p++) {
            const float grey[3] = {pixels[p], pixels[p], pixels[p]};
            const float shown[3] = {read.pixels[p], read.pixels[p], read.pixels[p]};
            judge_pixel(curves[k].judge, grey, 1, shown);
        }
        glint_image_free(&read);
    }
}

static void the_formats_that_stay_linear(void **state)
{
    (void)state;
    assert_true(glint_image_stays_linear("a.exr") && glint_image_stays_linear("b/a.HDR"));
    assert_false(glint_image_stays_linear("a.png") || glint_image_stays_linear("a.jpg") ||
                 glint_image_stays_linear("a.tiff") || glint_image_stays_linear("a.exr.xyz"));
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_curves_are_the_published_ones),
        cmocka_unit_test(none_keeps_every_bit),
        cmocka_unit_test(what_is_no_light_is_black_or_as_bright_as_can_be),
        cmocka_unit_test(black_is_black_and_white_has_room_above),
        cmocka_unit_test(more_light_is_never_darker),
        cmocka_unit_test(neutral_keeps_base_colours_and_hues),
        cmocka_unit_test(agx_keeps_grey),
        IN_FOLDER(files_are_mapped_after_exposure_and_without_alpha),
        IN_FOLDER(grey_files_are_mapped_as_grey),
        cmocka_unit_test(the_formats_that_stay_linear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
