// Transfer functions between linear light and the sRGB code values of 8-bit files.
#ifndef GLINT_IMAGE_COLOR_H
#define GLINT_IMAGE_COLOR_H

#ifdef __cplusplus
extern "C" {
#endif

// IEC 61966-2-1. Code value in [0, 1] to linear and back; NaN becomes 0 on encoding, values outside
// [0, 1] are clamped on encoding.
float glint_srgb_to_linear(float code);
float glint_linear_to_srgb(float linear);

// The nearest 8-bit code, 0 to 255: round(255 glint_linear_to_srgb(linear)), by table, for whole
// images. A value exactly between two codes gets the higher one.
unsigned char glint_linear_to_srgb8(float linear);

#ifdef __cplusplus
}
#endif

#endif
