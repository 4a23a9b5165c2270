// Signs of 5 × 7 dots for labels in pictures: no font files, which a fresh machine may lack.
#ifndef GLINT_REPORT_BITMAP_FONT_H
#define GLINT_REPORT_BITMAP_FONT_H

#include <stdbool.h>

// In dots. A sign stands at the left of its advance.
enum { GLINT_FONT_WIDTH = 5, GLINT_FONT_ADVANCE = 6, GLINT_FONT_HEIGHT = 7 };

// Whether the sign has a dot at (x, y), from its top left: 0 ≤ x < GLINT_FONT_WIDTH, 0 ≤ y <
// GLINT_FONT_HEIGHT. Signs: digits, . , + - / and the letters that labels are made of; any other is
// blank.
bool glint_font_dot(char sign, int x, int y);

#endif
