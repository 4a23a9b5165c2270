// How a file holds directions, and how it becomes a cube map.
#ifndef GLINT_ENVIRONMENT_LAYOUTS_H
#define GLINT_ENVIRONMENT_LAYOUTS_H

#include "base/status.h"
#include "environment/environment.h"
#include "image/image.h"
#include "image/image_io.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_FACE_EDGE_MAX 4096 // pixels; the cube then takes 1.6 GB

typedef struct glint_recognised {
    glint_layout layout; // in: what the user named, or UNKNOWN
    const char *reason;  // static text
    bool on_edges;       // texels lie on the edges and poles (envmap attribute), not at (i + ½)/N
} glint_recognised;

// What the single file `image` is: recognised->layout where the user named it, else the envmap
// attribute, else the shape. GLINT_BAD_INPUT, naming `path` and the choices, for a shape that does
// not suit or says too little.
glint_status glint_layout_recognise(const char *path, const glint_image *image,
                                    const glint_image_facts *facts, glint_recognised *recognised,
                                    glint_error *error);

// One face of a cube inside an image: N × N pixels from row `top` on, N the image's width.
typedef struct glint_face_view {
    const glint_image *image;
    int top;
} glint_face_view;

// The views are those of kernels/layout.h, in its order and orientation. Fills the border.
glint_status glint_cube_from_faces(const glint_face_view views[6], bool on_edges, glint_cube *cube,
                                   glint_error *error);

// Six faces named by OpenGL, RenderMan and Direct3D (posx negx posy negy posz negz), whose table is
// left-handed: the same pictures in the same orientation, posz straight ahead of a camera that
// looks along −Z. Sets views[] from the i-th face of `named`.
void glint_face_views_from_named(const glint_face_view named[6], glint_face_view views[6]);

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
