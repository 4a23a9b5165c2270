// Signs drawn as strokes. See stroke_font.h.
#include "stroke_font.h"

#include <math.h>

typedef struct stroke {
    char sign;
    double x0, y0, x1, y1;
} stroke;

static const stroke strokes[] = {
    {'+', 0.1, 0.5, 0.9, 0.5}, {'+', 0.5, 0.1, 0.5, 0.9}, {'-', 0.1, 0.5, 0.9, 0.5},
    {'X', 0, 0, 1, 1},         {'X', 0, 1, 1, 0},         {'Y', 0, 1, 0.5, 0.45},
    {'Y', 1, 1, 0.5, 0.45},    {'Y', 0.5, 0.45, 0.5, 0},  {'Z', 0, 1, 1, 1},
    {'Z', 1, 1, 0, 0},         {'Z', 0, 0, 1, 0},
};

static double segment_distance(const stroke *s, double x, double y)
{
    double dx = s->x1 - s->x0;
    double dy = s->y1 - s->y0;
    double along = ((x - s->x0) * dx + (y - s->y0) * dy) / (dx * dx + dy * dy);
    along = fmin(1, fmax(0, along)); // past its ends the distance is to the end: round caps
    return hypot(x - s->x0 - along * dx, y - s->y0 - along * dy);
}

double stroke_font_distance(char sign, double x, double y)
{
    double nearest = INFINITY;
    for (unsigned i = 0; i < sizeof strokes / sizeof strokes[0]; i++) {
        if (strokes[i].sign == sign) {
            nearest = fmin(nearest, segment_distance(&strokes[i], x, y));
        }
    }
    return nearest;
}
