// Draws labels with a built-in font of 5 × 7 dots: a new machine may have no font files.
#ifndef GLINT_REPORT_COMPARE_BITMAP_FONT_H
#define GLINT_REPORT_COMPARE_BITMAP_FONT_H

#include "image/image.h"

#include <stdbool.h>

// Sizes in dots. A glyph stands at the left of its advance.
enum { GLINT_FONT_WIDTH = 5, GLINT_FONT_ADVANCE = 6, GLINT_FONT_HEIGHT = 7 };

// True if the glyph has a dot at (x, y), counted from its top left: 0 ≤ x < GLINT_FONT_WIDTH, 0 ≤ y
// < GLINT_FONT_HEIGHT. The font has digits, letters and . , + - _ /; all else is blank. Capitals
// except N look like small letters.
bool glint_font_dot(char sign, int x, int y);

// Fills a box with a linear colour: columns from box[0], box[2] of them, and rows from box[1],
// box[3] of them. The image has three channels, and the box must lie within it.
void glint_font_fill(glint_image *image, const int box[4], const float color[3]);

// Draws a text with its top left at `at`; a dot is unit × unit pixels. The text must lie within the
// image.
void glint_font_draw(glint_image *image, const int at[2], int unit, const char *text,
                     const float color[3]);

#endif
