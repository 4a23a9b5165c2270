// Draws the labelled axes. See axes.h.
#include "environment/axes.h"

#include "kernels/layout.h"

#include <math.h>

// ---- Signs, drawn as strokes --------------------------------------------------------------------

// A stroke in a box from 0 to 1, y upwards.
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
    along = fmin(1, fmax(0, along)); // past an end the distance is to that end: round caps
    return hypot(x - s->x0 - along * dx, y - s->y0 - along * dy);
}

// The distance from (x, y) to the nearest stroke of the sign.
static double stroke_distance(char sign, double x, double y)
{
    double nearest = INFINITY;
    for (unsigned i = 0; i < sizeof strokes / sizeof strokes[0]; i++) {
        if (strokes[i].sign == sign) {
            nearest = fmin(nearest, segment_distance(&strokes[i], x, y));
        }
    }
    return nearest;
}

// ---- Faces --------------------------------------------------------------------------------------

typedef struct axis_face {
    char sign, letter;
    double color[3];
    glint_vec3 axis, right, up;
} axis_face;

static const axis_face faces[6] = {
    {'+', 'X', {0.80, 0.07, 0.05}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
    {'-', 'X', {0.02, 0.55, 0.60}, {-1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
    {'+', 'Y', {0.10, 0.55, 0.06}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
    {'-', 'Y', {0.52, 0.06, 0.50}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {'+', 'Z', {0.06, 0.16, 0.80}, {0, 0, 1}, {-1, 0, 0}, {0, 1, 0}},
    {'-', 'Z', {0.80, 0.45, 0.02}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
};

static const double line_color[3] = {0.06, 0.06, 0.07};
static const double label_color[3] = {0.95, 0.95, 0.92};

// The coverage of a line: 1 inside, 0 outside, a ramp of one pixel across the border.
static double coverage(double distance, double half_width, double pixel)
{
    return fmin(1, fmax(0, 0.5 + (half_width - distance) / pixel));
}

static void blend(double rgb[3], const double over[3], double share)
{
    for (int i = 0; i < 3; i++) {
        rgb[i] += (over[i] - rgb[i]) * share;
    }
}

// The distance from (s, t) on the face to the label's strokes. s runs to the right and t up, in ±1.
static double label_distance(const axis_face *face, double s, double t)
{
    const double size = 0.5; // the height and width of a sign
    const double gap = 0.16;
    double y = (t + 0.5 * size) / size;
    double sign = stroke_distance(face->sign, (s + size + 0.5 * gap) / size, y);
    double letter = stroke_distance(face->letter, (s - 0.5 * gap) / size, y);
    return size * fmin(sign, letter);
}

void glint_axes_color(glint_vec3 d, double pixel, double rgb[3])
{
    const axis_face *face = &faces[0];
    for (int i = 1; i < 6; i++) {
        if (glint_vec3_dot(d, faces[i].axis) > glint_vec3_dot(d, face->axis)) {
            face = &faces[i];
        }
    }
    double depth = glint_vec3_dot(d, face->axis);
    double s = glint_vec3_dot(d, face->right) / depth;
    double t = glint_vec3_dot(d, face->up) / depth;
    pixel *= 1 + s * s + t * t; // the slant of the face stretches a pixel
    double edge = 1 - fmax(fabs(s), fabs(t));
    double grid = fmin(fabs(fabs(s) - 0.5), fabs(fabs(t) - 0.5));
    for (int i = 0; i < 3; i++) {
        rgb[i] = face->color[i];
    }
    blend(rgb, line_color, coverage(edge, 0.012, pixel));
    blend(rgb, label_color, 0.25 * coverage(grid, 0.004, pixel));
    blend(rgb, label_color, coverage(label_distance(face, s, t), 0.045, pixel));
}

glint_status glint_axes_cube(int edge, glint_cube *cube, glint_error *error)
{
    TRY(glint_cube_create(edge, cube, error));
    for (int k = 0; k < GLINT_CUBE_FACES * edge * edge; k++) {
        const int face = k / edge / edge, i = k % edge, j = k / edge % edge;
        const double s = (2.0 * i + 1.0) / edge - 1.0, t = (2.0 * j + 1.0) / edge - 1.0;
        double rgb[3];
        // A texel is 2/edge wide in the face's plane. Away from the middle the plane is farther
        // off.
        glint_axes_color(glint_cube_direction(face, s, t), 2.0 / edge / (1 + s * s + t * t), rgb);
        glint_cube_store(cube, face, i, j, rgb);
    }
    glint_cube_fill_border(cube);
    return GLINT_OK;
}
