// Converts colours of other primaries to linear Rec. 709.
#ifndef GLINT_CODEC_PRIMARIES_H
#define GLINT_CODEC_PRIMARIES_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// CIE 1931 x and y of red, green, blue and white, in this order.
typedef struct glint_primaries {
    double xy[4][2];
} glint_primaries;

typedef struct glint_color_matrix {
    double rows[3][3]; // for column vectors
} glint_color_matrix;

// True if these are Rec. 709's, as far as the four digits of standards and headers say.
bool glint_primaries_are_rec709(const glint_primaries *primaries);

// Makes the matrix that converts linear colours of these primaries to linear Rec. 709. Grey stays
// grey: if the whites differ, Bradford's transform adapts the colours. But if the primaries are the
// axes of CIE XYZ, the colours are tristimulus values, and nothing adapts them: D65 becomes white.
// False if the primaries span no colours, or are not finite.
bool glint_primaries_to_rec709(const glint_primaries *primaries, glint_color_matrix *matrix);

// Multiplies colours by the matrix, at every `stride` floats. Leaves a colour that is not finite:
// the matrix would spread an infinity or a NaN to all three.
void glint_color_matrix_apply(const glint_color_matrix *matrix, float *pixels, size_t count,
                              size_t stride);

#ifdef __cplusplus
}
#endif

#endif
