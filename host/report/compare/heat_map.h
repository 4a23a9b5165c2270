// Paints where a picture differs from its reference.
#ifndef GLINT_REPORT_COMPARE_HEAT_MAP_H
#define GLINT_REPORT_COMPARE_HEAT_MAP_H

#include "base/status.h"
#include "image/image.h"

// The measure of differences of R, G and B. Relative: divided by the reference's component or its
// mean, whichever is larger (glint_pixel_error). Absolute: as they are.
typedef enum glint_heat {
    GLINT_HEAT_RELATIVE,
    GLINT_HEAT_ABSOLUTE,
} glint_heat;

// Paints each pixel in the colour of its largest difference, with a scale below (heat_scale.h;
// glint_heat_layout_for gives the size). `map` becomes a new linear image of three channels.
//
// The scale of relative differences ends at 1. The scale of absolute differences ends at the power
// of ten at or above the reference's mean. So all maps against one reference share one scale. The
// pictures must fit together as in metrics.h. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_heat_map_paint(const glint_image *image, const glint_image *reference,
                                  glint_heat heat, glint_image *map, glint_error *error);

// Makes a new image of the differences image − reference, as R, G and B. A pixel is NaN if either
// picture is not finite there. Errors: GLINT_OUT_OF_MEMORY.
glint_status glint_heat_map_differences(const glint_image *image, const glint_image *reference,
                                        glint_heat heat, glint_image *map, glint_error *error);

#endif
