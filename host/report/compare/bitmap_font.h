// Signs of 5 × 7 dots for labels in pictures: no font files, which a fresh machine may lack.
#ifndef GLINT_REPORT_COMPARE_BITMAP_FONT_H
#define GLINT_REPORT_COMPARE_BITMAP_FONT_H

#include "image/image.h"

#include <stdbool.h>

// In dots. A sign stands at the left of its advance.
enum { GLINT_FONT_WIDTH = 5, GLINT_FONT_ADVANCE = 6, GLINT_FONT_HEIGHT = 7 };

// Whether the sign has a dot at (x, y), from its top left: 0 ≤ x < GLINT_FONT_WIDTH, 0 ≤ y <
// GLINT_FONT_HEIGHT. Signs: digits, letters (capitals other than N look as small ones do) and
// . , + - _ /; any other is blank.
bool glint_font_dot(char sign, int x, int y);

// Fills columns box[0] to box[0] + box[2], rows box[1] to box[1] + box[3], their ends excluded, of
// an image of three channels with a colour (linear). The box lies within the image.
void glint_font_fill(glint_image *image, const int box[4], const float color[3]);

// Writes a text with its top left at `at`, a dot being unit × unit pixels; likewise within.
void glint_font_draw(glint_image *image, const int at[2], int unit, const char *text,
                     const float color[3]);

#endif
