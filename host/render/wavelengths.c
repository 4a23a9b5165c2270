// Chooses the wavelengths of dispersed light and their weights. See wavelengths.h.
#include "render/wavelengths.h"

#include <math.h>

// Fraunhofer's lines that define Abbe's number, in nm.
#define LINE_F 486.1
#define LINE_D 587.6
#define LINE_C 656.3
#define DISPERSION_OF_ABBE 20 // glTF's dispersion is this over Abbe's number

// The limits beyond which the eye sees little, in nm.
#define SHORTEST 400
#define LONGEST 700

static double inverse_square(double nm)
{
    return 1 / (nm * nm);
}

double glint_wavelength_ior_step(double nm)
{
    const double lines = inverse_square(LINE_F) - inverse_square(LINE_C);
    return (inverse_square(nm) - inverse_square(LINE_D)) / lines / DISPERSION_OF_ABBE;
}

// A bell curve with different widths below and above its peak.
static double bell(double nm, double peak, double below, double above)
{
    const double away = (nm - peak) * (nm < peak ? below : above);
    return exp(-away * away / 2);
}

// The colour of a wavelength in R, G and B of Rec.709. It uses the CIE's colour matching functions
// of 1931, as fitted by Wyman, Sloan and Shirley (Simple analytic approximations to the CIE XYZ
// color matching functions, 2013). Negative values lie outside these primaries and become 0.
static void color_of(double nm, double rgb[3])
{
    const double x = 1.056 * bell(nm, 599.8, 0.0264, 0.0323) +
                     0.362 * bell(nm, 442.0, 0.0624, 0.0374) -
                     0.065 * bell(nm, 501.1, 0.0490, 0.0382);
    const double y =
        0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322);
    const double z =
        1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725);
    rgb[0] = fmax(3.2404542 * x - 1.5371385 * y - 0.4985314 * z, 0);
    rgb[1] = fmax(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z, 0);
    rgb[2] = fmax(0.0556434 * x - 0.2040259 * y + 1.0572252 * z, 0);
}

double glint_wavelengths_most(int count)
{
    glint_wavelength wavelengths[GLINT_WAVELENGTHS_MAX];
    glint_wavelengths_choose(count, wavelengths);
    double most = 0;
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            most = fmax(most, count * wavelengths[i].share[c]);
        }
    }
    return most;
}

void glint_wavelengths_choose(int count, glint_wavelength wavelengths[])
{
    const double red = inverse_square(LONGEST), violet = inverse_square(SHORTEST);
    double sum[3] = {0, 0, 0}, weight[GLINT_WAVELENGTHS_MAX] = {0};
    double mean[GLINT_WAVELENGTHS_MAX] = {0};
    for (int i = 0; i < count; i++) {
        wavelengths[i] = (glint_wavelength){0};
    }
    for (int i = SHORTEST; i < LONGEST; i++) {
        const double nm = i + 0.5, place = inverse_square(nm);
        double rgb[3];
        color_of(nm, rgb);
        for (int c = 0; c < 3; c++) {
            const int part = count == 3 ? c : (int)(count * (place - red) / (violet - red));
            wavelengths[part].share[c] += rgb[c];
            mean[part] += rgb[c] * place;
            weight[part] += rgb[c];
            sum[c] += rgb[c];
        }
    }
    for (int i = 0; i < count; i++) {
        wavelengths[i].nm = count == 1 ? LINE_D : sqrt(weight[i] / mean[i]);
        for (int c = 0; c < 3; c++) {
            wavelengths[i].share[c] /= sum[c];
        }
    }
}
