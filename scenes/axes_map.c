// The labelled axis environment: a cube of six colours seen from inside, as a lat-long map.
//
// The map follows OpenEXR's ImfEnvmap.h: +Y up, +Z in the middle, +X a quarter in from the left
// edge: u = ½ − atan2(x, z)/2π, v = ½ − asin(y)/π, pixel centres at (i + ½)/N. The labels of the
// sides stand upright; +Y and −Y read upright for somebody who faces −Z, as the default camera
// does, and looks up or down: +Y has its lower edge towards −Z, −Y its upper edge.
#include "scenes.h"
#include "stroke_font.h"

enum { MAP_WIDTH = 1024, MAP_HEIGHT = 512 };

typedef struct axis_face {
    char sign, letter;
    double color[3]; // the largest component in [½, 1): one exponent in the whole RGBE file, which
                     // its run-length coding likes
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

// 1 inside, 0 outside, a ramp of one pixel across the border.
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

// The distance of the label's strokes from (s, t) on the face, s to the right, t up, each in ±1.
static double label_distance(const axis_face *face, double s, double t)
{
    const double size = 0.5; // the height and width of a sign
    const double gap = 0.16;
    double y = (t + 0.5 * size) / size;
    double sign = stroke_font_distance(face->sign, (s + size + 0.5 * gap) / size, y);
    double letter = stroke_font_distance(face->letter, (s - 0.5 * gap) / size, y);
    return size * fmin(sign, letter);
}

static void color_of_direction(glint_vec3 d, double rgb[3])
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
    // A pixel's height on the face: the angle of a row, stretched by the slant of the face there.
    double pixel = GLINT_PI / MAP_HEIGHT * (1 + s * s + t * t);
    double edge = 1 - fmax(fabs(s), fabs(t));
    double grid = fmin(fabs(fabs(s) - 0.5), fabs(fabs(t) - 0.5));
    for (int i = 0; i < 3; i++) {
        rgb[i] = face->color[i];
    }
    blend(rgb, line_color, coverage(edge, 0.012, pixel));
    blend(rgb, label_color, 0.25 * coverage(grid, 0.004, pixel));
    blend(rgb, label_color, coverage(label_distance(face, s, t), 0.045, pixel));
}

glint_status draw_axes_map(glint_image *image, glint_error *error)
{
    glint_status status = glint_image_create(MAP_WIDTH, MAP_HEIGHT, 3, image, error);
    if (status != GLINT_OK) {
        return status;
    }
    for (int row = 0; row < MAP_HEIGHT; row++) {
        double latitude = (0.5 - (row + 0.5) / MAP_HEIGHT) * GLINT_PI;
        for (int column = 0; column < MAP_WIDTH; column++) {
            double longitude = (0.5 - (column + 0.5) / MAP_WIDTH) * 2 * GLINT_PI;
            glint_vec3 direction = {cos(latitude) * sin(longitude), sin(latitude),
                                    cos(latitude) * cos(longitude)};
            double rgb[3];
            color_of_direction(direction, rgb);
            float *pixel = glint_image_pixel(image, column, row);
            for (int i = 0; i < 3; i++) {
                pixel[i] = (float)rgb[i];
            }
        }
    }
    return GLINT_OK;
}
