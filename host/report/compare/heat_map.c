// Paints where a picture differs from its reference. See heat_map.h.
#include "report/compare/heat_map.h"

#include "image/metrics.h"
#include "report/compare/heat_scale.h"

#include <math.h>
#include <string.h>

// The exponent of the upper end of the scale.
static int top_of(glint_heat heat, double mean)
{
    return heat == GLINT_HEAT_ABSOLUTE && mean != 0 ? (int)ceil(log10(fabs(mean))) : 0;
}

static void color_pixel(const glint_pixel_error *e, double difference, int top, float *pixel)
{
    if (!e->is_finite) {
        memcpy(pixel, glint_heat_not_finite, sizeof glint_heat_not_finite);
    } else if (difference > 0) {
        glint_heat_color(glint_heat_place(difference, top), pixel);
    } else {
        memcpy(pixel, glint_heat_equal, sizeof glint_heat_equal);
    }
}

glint_status glint_heat_map_paint(const glint_image *image, const glint_image *reference,
                                  glint_heat heat, glint_image *map, glint_error *error)
{
    const bool relative = heat == GLINT_HEAT_RELATIVE;
    const int width = reference->width, height = reference->height;
    const double mean = glint_metrics_mean(image, reference);
    const glint_heat_layout layout = glint_heat_layout_for(width, height);
    glint_heat_legend legend = {.measure = relative ? "relative" : "absolute",
                                .top = top_of(heat, mean)};
    glint_status status = glint_image_create(layout.width, layout.height, 3, map, error);
    if (status != GLINT_OK) {
        return status;
    }
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            size_t pixel = (size_t)y * (size_t)width + (size_t)x;
            glint_pixel_error e = glint_metrics_pixel(image, reference, pixel, mean);
            double difference = relative ? e.relative_most : e.absolute_most;
            color_pixel(&e, difference, legend.top, glint_image_pixel(map, x, y));
            if (e.is_finite && (!legend.has_worst || difference > legend.worst)) {
                legend.has_worst = true;
                legend.worst = difference;
                legend.worst_x = x;
                legend.worst_y = y;
            }
        }
    }
    glint_heat_scale_draw(&legend, &layout, width, map);
    return GLINT_OK;
}

glint_status glint_heat_map_differences(const glint_image *image, const glint_image *reference,
                                        glint_heat heat, glint_image *map, glint_error *error)
{
    const double mean = glint_metrics_mean(image, reference);
    glint_status status = glint_image_create(reference->width, reference->height, 3, map, error);
    if (status != GLINT_OK) {
        return status;
    }
    const size_t pixels = (size_t)reference->width * (size_t)reference->height;
    for (size_t i = 0; i < pixels; i++) {
        glint_pixel_error e = glint_metrics_pixel(image, reference, i, mean);
        const double *differences = heat == GLINT_HEAT_RELATIVE ? e.relative : e.difference;
        for (int k = 0; k < 3; k++) {
            map->pixels[3 * i + (size_t)k] = e.is_finite ? (float)differences[k] : NAN;
        }
    }
    return GLINT_OK;
}
