// The colours of a heat map, and the scale that stands below it and says what they mean.
#ifndef GLINT_REPORT_COMPARE_HEAT_SCALE_H
#define GLINT_REPORT_COMPARE_HEAT_SCALE_H

#include "image/image.h"

#include <stdbool.h>

// The scale is logarithmic over so many decades; what is past an end has the end's colour.
#define GLINT_HEAT_DECADES 6

// The place in [0, 1] of a difference > 0 (infinity too) on the scale whose upper end is 10^top.
double glint_heat_place(double difference, int top);

// Linear Rec.709 of a place on the scale, from blue by way of green and yellow to almost white
// (Green's cubehelix, 2011, "A colour scheme for the display of astronomical intensity images").
// Lightness rises with the place, by steps that stay within a factor of three of each other, so
// that the order shows in grey and to the colour-blind too.
void glint_heat_color(double place, float linear[3]);

// What has a colour off the scale: a pixel that is equal, and one that is not finite. The first is
// darker than the scale, the second (magenta) of a hue that the scale has not.
extern const float glint_heat_equal[3], glint_heat_not_finite[3];

// Where things stand in the map of pictures of one size, in pixels. Pixel (x, y) of the pictures is
// pixel (x, y) of the map; the scale takes the rows below, and a narrow map is widened for it.
typedef struct glint_heat_layout {
    int width, height;                       // of the whole
    int strip_y;                             // the scale's first row
    int unit;                                // the size of a dot of its text
    int equal_x, not_finite_x;               // the boxes beside the bar, of its height and squares
    int bar_x, bar_y, bar_width, bar_height; // the decades, from left to right
} glint_heat_layout;

glint_heat_layout glint_heat_layout_for(int width, int height);

// What the scale says beside its colours.
typedef struct glint_heat_legend {
    const char *measure; // "relative": what kind of difference the map shows
    int top;             // the scale ends at 10^top
    bool has_worst;      // false where no pixel could be compared
    double worst;        // the largest difference of all pixels
    int worst_x, worst_y;
} glint_heat_legend;

// Draws the scale, and the background beside the map, into `map`, of the layout's size and three
// channels. The pictures were `picture_width` wide.
void glint_heat_scale_draw(const glint_heat_legend *legend, const glint_heat_layout *layout,
                           int picture_width, glint_image *map);

#endif
