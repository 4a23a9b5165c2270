// Where the pixels of a layout look: from places in a picture to directions, and back.
#ifndef GLINT_ENVIRONMENT_CHART_H
#define GLINT_ENVIRONMENT_CHART_H

#include "base/status.h"
#include "base/vector.h"
#include "environment/layouts.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_FACE_EDGE_MAX 4096 // pixels; the cube then takes 1.6 GB

// A picture of a size, and how it holds directions. Places are in pixels, (0, 0) the picture's top
// left corner; pixel (i, j) has its centre at (i + ½, j + ½).
typedef struct glint_chart {
    glint_layout layout;      // neither UNKNOWN nor STUDIO; FACES is six files above each other
    int width, height;        // pixels
    bool on_edges;            // CUBE, LATLONG: the outermost centres lie on the edges and poles
    double center[2], radius; // BALL, ANGULAR: the disc; nothing is outside
    double distance;          // BALL: the viewer's from the ball's centre, in radii of the ball;
                              // over 1, infinity for one far away (orthographic)
} glint_chart;

// The chart of a picture of `size` pixels: a face's edge, or the height of a lat-long map or a
// disc, which fills its picture. GLINT_USAGE for one that is too large, or too small (a map whose
// centres lie on the edges has 2 at least).
glint_status glint_chart_make(glint_layout layout, int size, bool on_edges, glint_chart *chart,
                              glint_error *error);

// Where a face of a cube lies in a picture of faces, in faces, and whether it is turned by half.
typedef struct glint_face_cell {
    int column, row;
    bool is_turned;
} glint_face_cell;

// The places of the six faces, in the order and orientation of kernels/layout.h; NULL for layouts
// that are no cubes. *across × *down faces (which may be NULL) are the whole picture.
const glint_face_cell *glint_layout_cells(glint_layout layout, int *across, int *down);

// A place in pixel (i, j), at (dx, dy) pixels from its centre, half a pixel at most.
typedef struct glint_chart_place {
    int i, j;
    double dx, dy;
} glint_chart_place;

// The direction (not normalised) of a place. False where the picture holds none there: beside a
// cross, outside a disc.
bool glint_chart_direction(const glint_chart *chart, const glint_chart_place *at,
                           glint_vec3 *direction);

// The place where a disc shows a direction of any length but zero. What a ball hides from its
// viewer is on its rim.
void glint_disc_place(const glint_chart *chart, glint_vec3 direction, double place[2]);

// How many pixels long a small step from a direction is, in radians across it. At the poles of a
// lat-long map and at a disc's rim there is no bound; what is said there is finite.
double glint_chart_pixels(const glint_chart *chart, glint_vec3 direction, glint_vec3 step);

// How many pixels a quarter turn takes where the layout is at its finest and steadiest: along the
// horizon, across a face, from a disc's centre. What makes charts of different layouts comparable.
double glint_chart_quarter_turn(const glint_chart *chart);

// The size, as of glint_chart_make, whose quarter turn takes so many pixels; the largest there is
// where that would be too large.
int glint_chart_size_for(glint_layout layout, double quarter_turn);

#ifdef __cplusplus
}
#endif

#endif
