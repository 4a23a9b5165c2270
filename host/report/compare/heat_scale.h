// Defines the colours of a heat map and draws the scale below it.
#ifndef GLINT_REPORT_COMPARE_HEAT_SCALE_H
#define GLINT_REPORT_COMPARE_HEAT_SCALE_H

#include "image/image.h"

#include <stdbool.h>

// Decades of the logarithmic scale. Values beyond an end get the colour of the end.
#define GLINT_HEAT_DECADES 6

// The position on the scale, [0, 1], of a difference > 0 (infinity too). The scale ends at 10^top.
double glint_heat_place(double difference, int top);

// The linear Rec.709 colour of a position on the scale, from blue through green and yellow to
// almost white (Green's cubehelix, 2011, "A colour scheme for the display of astronomical intensity
// images"). Lightness rises with the position, in steps within a factor of three of each other. So
// the order also shows in grey and to colour-blind readers.
void glint_heat_color(double place, float linear[3]);

// Colours outside the scale: of equal pixels, darker than the scale, and of pixels that are not
// finite, magenta, a hue that the scale does not have.
extern const float glint_heat_equal[3], glint_heat_not_finite[3];

// The layout of a map for pictures of one size, in pixels. Pixel (x, y) of the pictures is pixel
// (x, y) of the map. The scale takes the rows below; a narrow map is widened for it.
typedef struct glint_heat_layout {
    int width, height;                       // of the whole map
    int strip_y;                             // first row of the scale
    int unit;                                // pixels per dot of the text
    int equal_x, not_finite_x;               // squares beside the bar, as high as the bar
    int bar_x, bar_y, bar_width, bar_height; // the bar of colours, smallest values at the left
} glint_heat_layout;

glint_heat_layout glint_heat_layout_for(int width, int height);

// The text of the scale.
typedef struct glint_heat_legend {
    const char *measure; // kind of difference: "relative" or "absolute"
    int top;             // the scale ends at 10^top
    bool has_worst;      // false if no pixel was compared
    double worst;        // largest difference of all pixels
    int worst_x, worst_y;
} glint_heat_legend;

// Draws the scale, and the background beside the pictures, into `map`. `map` has the layout's size
// and three channels. The pictures were `picture_width` wide.
void glint_heat_scale_draw(const glint_heat_legend *legend, const glint_heat_layout *layout,
                           int picture_width, glint_image *map);

#endif
