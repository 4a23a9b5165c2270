// Chooses the wavelengths for solids that disperse light (KHR_materials_dispersion).
#ifndef GLINT_RENDER_WAVELENGTHS_H
#define GLINT_RENDER_WAVELENGTHS_H

#include "kernels/layout.h"

typedef struct glint_wavelength {
    double nm; // wavelength in nm
    // Its share of linear Rec.709 R, G, B, ≥ 0. The shares of all wavelengths add up to 1.
    double share[3];
} glint_wavelength;

// Chooses `count` wavelengths (1 to GLINT_WAVELENGTHS_MAX), from red to violet. Three wavelengths
// are the means for R, G and B. Other numbers divide the visible range into parts of equal change
// of the index of refraction. One wavelength is the sodium line d, for which glTF gives the index.
void glint_wavelengths_choose(int count, glint_wavelength wavelengths[]);

// The largest weight of a path that follows one wavelength: its share times `count`.
double glint_wavelengths_most(int count);

// The index of refraction at `nm` minus the index at line d, divided by (ior − 1) × dispersion.
// Cauchy's equation with glTF's numbers for the lines F, d and C. The kernels keep the index at 1
// or above.
double glint_wavelength_ior_step(double nm);

#endif
