// Makes cube maps from pictures that hold the six faces.
#ifndef GLINT_ENVIRONMENT_FACES_H
#define GLINT_ENVIRONMENT_FACES_H

#include "base/status.h"
#include "environment/chart.h"
#include "environment/cube.h"
#include "image/image.h"
#include "image/stored.h"

#ifdef __cplusplus
extern "C" {
#endif

// Looks up (s, t) of a face bilinearly (see kernels/layout.h). The picture is OpenEXR's cube with
// the outermost centres on the faces' edges, so the look-up needs no neighbour.
void glint_face_on_edges(const glint_image *image, int face, double s, double t, double rgb[3]);

// Makes a cube with the edge of the picture's faces and fills its border. If the outermost centres
// lie on the edges, the cube's texels are interpolated.
glint_status glint_cube_from_faces(const glint_image *image, const glint_chart *chart,
                                   glint_cube *cube, glint_error *error);

// Does the same with a picture that is not converted yet, whose centres lie inside.
glint_status glint_cube_from_stored_faces(const glint_stored *stored, const glint_chart *chart,
                                          glint_cube *cube, glint_error *error);

#ifdef __cplusplus
}
#endif

#endif
