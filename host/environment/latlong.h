// Lat-long maps, the layout that most environments come in.
#ifndef GLINT_ENVIRONMENT_LATLONG_H
#define GLINT_ENVIRONMENT_LATLONG_H

#include "base/status.h"
#include "environment/cube.h"
#include "image/image.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// The edge of the cube that keeps what a lat-long map of this height holds, between 256 and 2048:
// of maps of more than 3200 rows the finest detail is lost.
int glint_latlong_edge(int height);

// Resamples a lat-long map into a cube of `edge` texels and fills the border. Bilinear; where a
// texel of the cube covers more than one of the map, the mean of a grid of look-ups.
glint_status glint_cube_from_latlong(const glint_image *image, bool on_edges, int edge,
                                     glint_cube *cube, glint_error *error);

// The bilinear look-up in a lat-long map along a direction of any length but zero. Columns wrap,
// and across a pole the map goes on half a turn away.
void glint_latlong_sample(const glint_image *image, bool on_edges, glint_vec3 direction,
                          double rgb[3]);

#ifdef __cplusplus
}
#endif

#endif
