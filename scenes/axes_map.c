// Draws the labelled axis environment as a lat-long map.
//
// The map follows OpenEXR's ImfEnvmap.h: +Y up, +Z in the middle, +X a quarter in from the left
// edge. u = ½ − atan2(x, z)/2π, v = ½ − asin(y)/π, pixel centres at (i + ½)/N. The largest
// component
// of each colour is in [½, 1): the whole RGBE file has one exponent, so run-length coding works
// well.
#include "scenes.h"

#include "environment/axes.h"

enum { MAP_WIDTH = 1024, MAP_HEIGHT = 512 };

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
            glint_axes_color(direction, GLINT_PI / MAP_HEIGHT, rgb);
            float *pixel = glint_image_pixel(image, column, row);
            for (int i = 0; i < 3; i++) {
                pixel[i] = (float)rgb[i];
            }
        }
    }
    return GLINT_OK;
}
