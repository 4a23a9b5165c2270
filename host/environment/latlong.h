// Looks up and converts lat-long maps, the most common layout of environments.
#ifndef GLINT_ENVIRONMENT_LATLONG_H
#define GLINT_ENVIRONMENT_LATLONG_H

#include "base/status.h"
#include "environment/cube.h"
#include "image/image.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// The edge, between 256 and 2048, of the cube that keeps the detail of a lat-long map of this
// height. Maps of more than 3200 rows lose their finest detail.
int glint_latlong_edge(int height);

// Resamples a lat-long map into a cube of `edge` texels and fills the border. Look-ups are
// bilinear. If a texel of the cube covers more than one pixel of the map, it is the mean of a grid
// of look-ups.
glint_status glint_cube_from_latlong(const glint_image *image, bool on_edges, int edge,
                                     glint_cube *cube, glint_error *error);

// Looks up a direction of any length but zero in a lat-long map, bilinearly. Columns wrap around.
// Across a pole the map continues half a turn away.
void glint_latlong_sample(const glint_image *image, bool on_edges, glint_vec3 direction,
                          double rgb[3]);

#ifdef __cplusplus
}
#endif

#endif
