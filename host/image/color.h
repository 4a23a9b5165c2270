// Converts between linear light and the sRGB code values of 8-bit files.
#ifndef GLINT_IMAGE_COLOR_H
#define GLINT_IMAGE_COLOR_H

#ifdef __cplusplus
extern "C" {
#endif

// Convert a code value in [0, 1] to linear light and back (IEC 61966-2-1). Encoding turns NaN into
// 0 and clamps values outside [0, 1].
float glint_srgb_to_linear(float code);
float glint_linear_to_srgb(float linear);

// The nearest 8-bit code, round(255 glint_linear_to_srgb(linear)), from a table, for whole images.
// A value exactly between two codes gets the higher code.
unsigned char glint_linear_to_srgb8(float linear);

#ifdef __cplusplus
}
#endif

#endif
