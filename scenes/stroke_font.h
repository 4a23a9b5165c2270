// Signs drawn as strokes, for labels in pictures: no font files, no outlines.
#ifndef GLINT_SCENES_STROKE_FONT_H
#define GLINT_SCENES_STROKE_FONT_H

// The distance from (x, y) to the nearest stroke of the sign, whose box is 0 ≤ x ≤ 1 wide and
// 0 ≤ y ≤ 1 high, y upwards. Signs: + - X Y Z. Infinity for any other.
double stroke_font_distance(char sign, double x, double y);

#endif
