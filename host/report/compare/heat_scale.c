// Defines the colours of a heat map and draws its scale. See heat_scale.h.
#include "report/compare/heat_scale.h"

#include "image/color.h"
#include "report/compare/bitmap_font.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const float glint_heat_equal[3] = {0, 0, 0};
const float glint_heat_not_finite[3] = {1, 0, 1};

// sRGB codes 32 and 224, as linear light.
static const float background[3] = {0.0144F, 0.0144F, 0.0144F};
static const float ink[3] = {0.7454F, 0.7454F, 0.7454F};

// ---- Colours ------------------------------------------------------------------------------------

double glint_heat_place(double difference, int top)
{
    double place = (log10(difference) - top) / GLINT_HEAT_DECADES + 1;
    return fmin(1, fmax(0, place));
}

// Parameters of Green's formula. With them all components stay within [0, 1] for fractions from
// DARKEST to BRIGHTEST.
#define START 0.25       // hue at fraction 0, in thirds of the colour circle, from blue
#define ROTATIONS (-0.7) // turns from there through green to yellow and red
#define HUE 1.5          // saturation
#define DARKEST 0.2      // lower end of the scale; equal pixels are darker
#define BRIGHTEST 0.98

void glint_heat_color(double place, float linear[3])
{
    const double fraction = DARKEST + (BRIGHTEST - DARKEST) * place;
    const double angle = 2 * M_PI * (START / 3 + ROTATIONS * fraction);
    const double amplitude = HUE * fraction * (1 - fraction) / 2;
    const double c = amplitude * cos(angle), s = amplitude * sin(angle);
    const double codes[3] = {
        fraction - 0.14861 * c + 1.78277 * s,
        fraction - 0.29227 * c - 0.90649 * s,
        fraction + 1.97294 * c,
    };
    for (int k = 0; k < 3; k++) {
        linear[k] = glint_srgb_to_linear((float)codes[k]);
    }
}

// ---- Where things stand -------------------------------------------------------------------------

// In units of `unit` pixels. A label under the bar has at most five characters ("1e-45"); half of
// it may stand out at either end.
enum {
    MARGIN = 6,
    GAP = 4,
    MARKER = 4, // height of the triangle
    BAR = 9,    // height of the bar
    TICK = 3,
    LABEL = 5 * GLINT_FONT_ADVANCE,
    NOT_FINITE = 7 * GLINT_FONT_ADVANCE, // "NaN/inf"
    LEFT = MARGIN + BAR + GAP + LABEL / 2,
    RIGHT = MARGIN + NOT_FINITE + GAP + LABEL / 2,
    TITLE_Y = MARGIN,
    BAR_Y = TITLE_Y + GLINT_FONT_HEIGHT + GAP + MARKER,
    LABEL_Y = BAR_Y + BAR + TICK + 1,
    STRIP = LABEL_Y + GLINT_FONT_HEIGHT + MARGIN,
    NARROWEST = 312, // the longest title, and LABEL for each decade
    // pixels of width per unit, so that text stays readable in a large map that is shown smaller
    UNIT_FOR_WIDTH = 640
};

glint_heat_layout glint_heat_layout_for(int width, int height)
{
    const int unit = width < 2 * UNIT_FOR_WIDTH ? 1 : width / UNIT_FOR_WIDTH;
    const int whole = width > NARROWEST * unit ? width : NARROWEST * unit;
    return (glint_heat_layout){
        .width = whole,
        .height = height + STRIP * unit,
        .strip_y = height,
        .unit = unit,
        .equal_x = MARGIN * unit,
        .not_finite_x = whole - (MARGIN + (NOT_FINITE + BAR) / 2) * unit,
        .bar_x = LEFT * unit,
        .bar_y = height + BAR_Y * unit,
        .bar_width = whole - (LEFT + RIGHT) * unit,
        .bar_height = BAR * unit,
    };
}

// ---- Drawing ------------------------------------------------------------------------------------

// Draws a label under the bar, centred at x.
static void draw_label(const glint_heat_layout *layout, int x, const char *text, glint_image *map)
{
    const int width = ((int)strlen(text) * GLINT_FONT_ADVANCE - 1) * layout->unit;
    const int at[2] = {x - width / 2, layout->strip_y + LABEL_Y * layout->unit};
    glint_font_draw(map, at, layout->unit, text, ink);
}

static void draw_box(const glint_heat_layout *layout, int x, const float color[3], const char *text,
                     glint_image *map)
{
    const int side = layout->bar_height, unit = layout->unit;
    const int frame[4] = {x - unit, layout->bar_y - unit, side + 2 * unit, side + 2 * unit};
    const int box[4] = {x, layout->bar_y, side, side};
    glint_font_fill(map, frame, ink); // without a frame, black would be lost on the dark background
    glint_font_fill(map, box, color);
    draw_label(layout, x + side / 2, text, map);
}

static void draw_bar(const glint_heat_legend *legend, const glint_heat_layout *layout,
                     glint_image *map)
{
    for (int x = 0; x < layout->bar_width; x++) {
        float color[3];
        glint_heat_color((x + 0.5) / layout->bar_width, color);
        const int column[4] = {layout->bar_x + x, layout->bar_y, 1, layout->bar_height};
        glint_font_fill(map, column, color);
    }
    for (int k = 0; k <= GLINT_HEAT_DECADES; k++) {
        const int exponent = legend->top - GLINT_HEAT_DECADES + k;
        const int x = layout->bar_x + layout->bar_width * k / GLINT_HEAT_DECADES;
        const int tick[4] = {x - layout->unit / 2, layout->bar_y + layout->bar_height, layout->unit,
                             TICK * layout->unit};
        char text[16];
        snprintf(text, sizeof text, exponent == 0 ? "1" : "1e%d", exponent);
        glint_font_fill(map, tick, ink);
        draw_label(layout, x, text, map);
    }
}

// Draws a triangle that points down at the largest difference.
static void draw_marker(const glint_heat_legend *legend, const glint_heat_layout *layout,
                        glint_image *map)
{
    const double place = glint_heat_place(legend->worst, legend->top);
    const int x = layout->bar_x + (int)lround(place * layout->bar_width);
    for (int row = 0; row < MARKER * layout->unit; row++) {
        const int line[4] = {x - row, layout->bar_y - 1 - row, 2 * row + 1, 1};
        glint_font_fill(map, line, ink);
    }
}

static void draw_title(const glint_heat_legend *legend, const glint_heat_layout *layout,
                       glint_image *map)
{
    char text[64];
    if (!legend->has_worst) {
        snprintf(text, sizeof text, "%s difference, none finite", legend->measure);
    } else if (legend->worst > 0) {
        snprintf(text, sizeof text, "%s difference, worst %.3g at %d,%d", legend->measure,
                 legend->worst, legend->worst_x, legend->worst_y);
    } else {
        snprintf(text, sizeof text, "%s difference, worst 0", legend->measure);
    }
    const int at[2] = {MARGIN * layout->unit, layout->strip_y + TITLE_Y * layout->unit};
    glint_font_draw(map, at, layout->unit, text, ink);
}

void glint_heat_scale_draw(const glint_heat_legend *legend, const glint_heat_layout *layout,
                           int picture_width, glint_image *map)
{
    const int strip[4] = {0, layout->strip_y, layout->width, layout->height - layout->strip_y};
    const int beside[4] = {picture_width, 0, layout->width - picture_width, layout->strip_y};
    glint_font_fill(map, strip, background);
    glint_font_fill(map, beside, background);
    draw_title(legend, layout, map);
    draw_box(layout, layout->equal_x, glint_heat_equal, "0", map);
    draw_bar(legend, layout, map);
    draw_box(layout, layout->not_finite_x, glint_heat_not_finite, "NaN/inf", map);
    if (legend->has_worst && legend->worst > 0) {
        draw_marker(legend, layout, map);
    }
}
