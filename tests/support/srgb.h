// The transfer functions of IEC 61966-2-1 in double precision, without glint's code.
#ifndef GLINT_TESTS_SUPPORT_SRGB_H
#define GLINT_TESTS_SUPPORT_SRGB_H

#include <math.h>

// Both take and return values from 0 to 1.
static inline double srgb_from_linear(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

static inline double linear_from_srgb(double code)
{
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

#endif
