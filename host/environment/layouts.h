// How files hold directions: names, recognising them, and faces that become a cube map.
#ifndef GLINT_ENVIRONMENT_LAYOUTS_H
#define GLINT_ENVIRONMENT_LAYOUTS_H

#include "base/status.h"
#include "environment/chart.h"
#include "environment/environment.h"
#include "image/image.h"
#include "image/image_io.h"

#ifdef __cplusplus
extern "C" {
#endif

// What a single file is.
typedef struct glint_recognised {
    glint_chart chart;
    const char *reason; // static text
} glint_recognised;

// What the single file `image` is: what the user named, else what the envmap attribute says, else
// its shape. GLINT_BAD_INPUT, naming `path` and the choices, for a shape that does not suit or says
// too little, and for a disc that leaves the picture.
glint_status glint_layout_recognise(const char *path, const glint_image *image,
                                    const glint_image_facts *facts,
                                    const glint_layout_request *request,
                                    glint_recognised *recognised, glint_error *error);

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
