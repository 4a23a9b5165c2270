// Where a picture differs from the one that it should be, as a picture.
#ifndef GLINT_REPORT_COMPARE_HEAT_MAP_H
#define GLINT_REPORT_COMPARE_HEAT_MAP_H

#include "base/status.h"
#include "image/image.h"

// How differences of R, G and B are counted: over the reference's component or its mean, whichever
// is larger (glint_pixel_error), or as they are.
typedef enum glint_heat {
    GLINT_HEAT_RELATIVE,
    GLINT_HEAT_ABSOLUTE,
} glint_heat;

// Paints each pixel in the colour of its largest difference, with the scale below (heat_scale.h;
// glint_heat_layout_for gives the size). Relative differences have the decades up to 1; absolute
// ones those up to the power of ten at or above the reference's mean, so that maps against one
// reference share one scale. `map` becomes a new image of three channels, linear. Pictures as in
// metrics.h. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_heat_map_paint(const glint_image *image, const glint_image *reference,
                                  glint_heat heat, glint_image *map, glint_error *error);

// The differences themselves, image − reference, as R, G and B of a new image of the pictures'
// size; NaN where one of the two is not finite. Errors as above.
glint_status glint_heat_map_differences(const glint_image *image, const glint_image *reference,
                                        glint_heat heat, glint_image *map, glint_error *error);

#endif
