// The wavelengths that light is divided into by solids that disperse it (KHR_materials_dispersion).
#ifndef GLINT_RENDER_WAVELENGTHS_H
#define GLINT_RENDER_WAVELENGTHS_H

#include "kernels/layout.h"

typedef struct glint_wavelength {
    double nm;       // its wavelength
    double share[3]; // of linear Rec.709 R, G, B, ≥ 0; the shares of all wavelengths add up to 1
} glint_wavelength;

// `count` wavelengths, 1 to GLINT_WAVELENGTHS_MAX, from red to violet. Three are one for each of R,
// G and B: its mean. Other numbers divide the visible range into parts over which the index of
// refraction rises alike. One is the sodium line d, at which glTF gives the index.
void glint_wavelengths_choose(int count, glint_wavelength wavelengths[]);

// The largest weight of a path of one wavelength that stands for all: a share, times `count`.
double glint_wavelengths_most(int count);

// How far the index of refraction has risen there from that at line d, over (ior − 1) × dispersion:
// Cauchy's equation by glTF's numbers for the lines F, d and C. The index does not fall below 1.
double glint_wavelength_ior_step(double nm);

#endif
