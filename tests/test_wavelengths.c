// Tests the wavelengths of dispersion, their shares and places, against the CIE's own table.
#include "render/wavelengths.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// By glTF's numbers: n(λ) = n_d + (n_d − 1)/V (523655/λ² − 1.5168), here for (n_d − 1) × 20/V = 1.
static void the_index_rises_as_gltf_says(void **state)
{
    (void)state;
    for (int nm = 390; nm <= 750; nm += 10) {
        const double rise = (523655.0 / (nm * nm) - 1.5168) / 20;
        // glTF's constants are rounded.
        assert_true(fabs(glint_wavelength_ior_step(nm) - rise) < 1e-4);
    }
    const double lines = glint_wavelength_ior_step(486.1) - glint_wavelength_ior_step(656.3);
    assert_true(fabs(lines - 0.05) < 1e-12); // the definition of Abbe's number
    assert_true(glint_wavelength_ior_step(587.6) == 0);
}

static void shares_add_up_and_wavelengths_fall(void **state)
{
    (void)state;
    for (int count = 1; count <= GLINT_WAVELENGTHS_MAX; count++) {
        glint_wavelength of[GLINT_WAVELENGTHS_MAX];
        glint_wavelengths_choose(count, of);
        double sum[3] = {0, 0, 0};
        for (int i = 0; i < count; i++) {
            for (int c = 0; c < 3; c++) {
                assert_true(of[i].share[c] >= 0);
                sum[c] += of[i].share[c];
            }
            assert_true(of[i].nm > 400 && of[i].nm < 700);
            assert_true(i == 0 || of[i].nm < of[i - 1].nm);
        }
        for (int c = 0; c < 3; c++) {
            assert_true(fabs(sum[c] - 1) < 1e-12);
        }
    }
}

// The standard observer of 1931 from 400 to 700 nm, every 20: X, Y, Z.
static const double observer[][3] = {
    {0.01431, 0.000396, 0.06785}, {0.13438, 0.0040, 0.6456},   {0.34828, 0.0230, 1.74706},
    {0.2908, 0.0600, 1.6692},     {0.09564, 0.13902, 0.81295}, {0.0049, 0.3230, 0.2720},
    {0.06327, 0.7100, 0.07825},   {0.2904, 0.9540, 0.0203},    {0.5945, 0.9950, 0.0039},
    {0.9163, 0.8700, 0.00165},    {1.0622, 0.6310, 0.0008},    {0.85445, 0.3810, 0.00019},
    {0.4479, 0.1750, 0.00002},    {0.1649, 0.0610, 0},         {0.04677, 0.0170, 0},
    {0.01136, 0.0041, 0},
};
#define OBSERVED (int)(sizeof observer / sizeof *observer)

// Mean of 1/λ² over the observer's response to a primary of Rec.709.
static double mean_place(const double primary[3])
{
    double sum = 0, places = 0;
    for (int i = 0; i < OBSERVED; i++) {
        const double *o = observer[i], nm = 400 + 20 * i;
        const double seen = fmax(primary[0] * o[0] + primary[1] * o[1] + primary[2] * o[2], 0);
        sum += seen;
        places += seen / (nm * nm);
    }
    return places / sum;
}

// Three wavelengths are the means of the primaries. The maximum number has the same means.
static void each_primary_keeps_its_mean(void **state)
{
    (void)state;
    static const double primaries[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                           {-0.9692660, 1.8760108, 0.0415560},
                                           {0.0556434, -0.2040259, 1.0572252}};
    glint_wavelength three[3], all[GLINT_WAVELENGTHS_MAX];
    glint_wavelengths_choose(3, three);
    glint_wavelengths_choose(GLINT_WAVELENGTHS_MAX, all);
    for (int c = 0; c < 3; c++) {
        const double nm = sqrt(1 / mean_place(primaries[c]));
        double mean = 0;
        for (int i = 0; i < GLINT_WAVELENGTHS_MAX; i++) {
            mean += all[i].share[c] / (all[i].nm * all[i].nm);
        }
        print_message("channel %d: %.2f nm, the table's %.2f, of all %.2f\n", c, three[c].nm, nm,
                      sqrt(1 / mean));
        assert_true(three[c].share[c] == 1);
        assert_true(fabs(three[c].nm - nm) < 2);
        assert_true(fabs(three[c].nm - sqrt(1 / mean)) < 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_index_rises_as_gltf_says),
        cmocka_unit_test(shares_add_up_and_wavelengths_fall),
        cmocka_unit_test(each_primary_keeps_its_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
