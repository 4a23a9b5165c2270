// Cube maps made of pictures that hold the six faces.
#ifndef GLINT_ENVIRONMENT_FACES_H
#define GLINT_ENVIRONMENT_FACES_H

#include "base/status.h"
#include "environment/chart.h"
#include "environment/cube.h"
#include "image/image.h"

#ifdef __cplusplus
extern "C" {
#endif

// The bilinear look-up at (s, t), see kernels/layout.h, of a face of OpenEXR's cube whose outermost
// centres lie on its edges: no neighbour is needed.
void glint_face_on_edges(const glint_image *image, int face, double s, double t, double rgb[3]);

// A cube with the edge of a picture's faces; fills the border. Where the outermost centres lie on
// the edges, its texels are interpolated.
glint_status glint_cube_from_faces(const glint_image *image, const glint_chart *chart,
                                   glint_cube *cube, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
