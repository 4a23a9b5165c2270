// The environment: radiance by direction, E(d), held as a cube map.
#ifndef GLINT_ENVIRONMENT_ENVIRONMENT_H
#define GLINT_ENVIRONMENT_ENVIRONMENT_H

#include "base/status.h"
#include "base/vector.h"
#include "image/image.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// A cube map in the layout of kernels/layout.h: linear Rec.709 radiance, texel centres at
// (i + ½)/edge, each face with a border of one texel made from its neighbours, so that bilinear
// filtering is continuous over edges and corners, and right there to second order in 1/edge.
// Zero is valid: no texels.
typedef struct glint_cube {
    int edge;      // texels along a face's edge, without the border
    float *texels; // [6][edge + 2][edge + 2][4], owned
} glint_cube;

glint_status glint_cube_create(int edge, glint_cube *cube, glint_error *error);
void glint_cube_free(glint_cube *cube);

// The number of floats in `texels`.
size_t glint_cube_size(const glint_cube *cube);

// The texel of `face` at column i and row j, each in [−1, edge].
float *glint_cube_texel(const glint_cube *cube, int face, int i, int j);

// Sets that texel.
void glint_cube_store(const glint_cube *cube, int face, int i, int j, const double rgb[3]);

// Fills the border from the neighbours' texels; called once the inside is complete.
void glint_cube_fill_border(glint_cube *cube);

// Mends what is no radiance as in files (see source.c), with a warning that names `name`, and fills
// the border anew. Returns how many texels it was.
size_t glint_cube_mend(const char *name, glint_cube *cube, glint_warnings *warnings);

// The direction (not normalised) of the point (s, t) on a face, see kernels/layout.h.
glint_vec3 glint_cube_direction(int face, double s, double t);

// The face that a direction meets, and the point (s, t) there. On a tie of the largest components
// the order x, y, z decides, as in ImfEnvmap.h and cubemap.cl.
int glint_cube_place(glint_vec3 direction, double *s, double *t);

// Mirrors the cube along the axes that are named in `flip` ("x" exchanges left and right, "xz" is
// half a turn): each texel is another one as it was. Errors: GLINT_OUT_OF_MEMORY, with the
// cube unchanged.
glint_status glint_cube_mirror(glint_cube *cube, const char *flip, glint_error *error);

// Bilinear look-up along a direction of any length but zero.
void glint_cube_sample(const glint_cube *cube, glint_vec3 direction, double rgb[3]);

// How a file holds directions.
typedef enum glint_layout {
    GLINT_LAYOUT_UNKNOWN, // as an argument: to be recognised
    GLINT_LAYOUT_CUBE,    // OpenEXR's 1 × 6 strip
    GLINT_LAYOUT_FACES,   // six files
    GLINT_LAYOUT_HCROSS,  // 4 × 3 faces
    GLINT_LAYOUT_VCROSS,  // 3 × 4
    GLINT_LAYOUT_VSTRIP,  // 1 × 6, in OpenGL's and Direct3D's order
    GLINT_LAYOUT_HSTRIP,  // 6 × 1, likewise
    GLINT_LAYOUT_LATLONG,
    GLINT_LAYOUT_BALL,    // a mirror ball's picture
    GLINT_LAYOUT_ANGULAR, // a disc: the angle from its middle is the distance from there
    GLINT_LAYOUT_STUDIO,  // built in, no file
} glint_layout;

// The name on the command line ("latlong"); NULL for UNKNOWN.
const char *glint_layout_name(glint_layout layout);

// UNKNOWN for a name that is none.
glint_layout glint_layout_from_name(const char *name);

// What is known of a file beside its content. Zero is valid: nothing.
typedef struct glint_layout_request {
    glint_layout layout;  // UNKNOWN: to be recognised
    double circle[3];     // BALL, ANGULAR: the disc's centre and radius in pixels, (0, 0) the top
                          // left corner; radius 0: the circle that fills the picture's middle
    double ball_distance; // BALL: see glint_chart; 0: far away, or as ball_fov has it
    double ball_fov;      // BALL: the camera's vertical angle of view in degrees, under 180, of the
                          // whole picture, which tells the distance; 0: not known
} glint_layout_request;

// Where what an environment shows is taken to be: on the inside of a box or a sphere, so that
// mirrors in different places see different sides of it. All in metres, world space.
typedef enum glint_proxy_kind {
    GLINT_PROXY_NONE, // infinitely far away
    GLINT_PROXY_BOX,
    GLINT_PROXY_SPHERE,
} glint_proxy_kind;

typedef struct glint_proxy {
    glint_proxy_kind kind;
    glint_vec3 center;      // where the environment was seen from, inside the proxy
    glint_vec3 middle;      // of the proxy
    glint_vec3 half_extent; // along each axis; of a sphere the radius thrice
} glint_proxy;

typedef struct glint_environment {
    char *name;          // the file as given, or "studio"
    glint_layout layout; // what it was read as
    const char *reason;  // how that was known: "envmap attribute", "shape 2:1", …; static text
    int source_width, source_height;
    glint_cube radiance;
    glint_proxy proxy;    // heeded where the settings say so
    size_t mended_texels; // NaN, infinite or negative ones, replaced (see source.c)
} glint_environment;

// Reads `path`: a file, a folder that holds six faces, or a pattern with one %s for the face's
// name. The layout, where `request` does not say, is recognised from the envmap attribute, the name
// pattern and the shape; an ambiguous shape is refused with the choices named. `request` may be
// NULL. Errors: GLINT_BAD_INPUT.
glint_status glint_environment_load(const char *path, const glint_layout_request *request,
                                    glint_environment *environment, glint_warnings *warnings,
                                    glint_error *error);

// The same from an image in memory, called `name` in messages: a single file's content. Values that
// are no radiance are mended in it. Errors: GLINT_BAD_INPUT.
glint_status glint_environment_from_image(const char *name, glint_image *image,
                                          const glint_layout_request *request,
                                          glint_environment *environment, glint_warnings *warnings,
                                          glint_error *error);

// The built-in studio: a soft box overhead, two strips at the sides, a floor and a horizon, so that
// mirrors and glass have something to show.
glint_status glint_environment_studio(glint_environment *environment, glint_error *error);

void glint_environment_free(glint_environment *environment);

#ifdef __cplusplus
}
#endif

#endif
