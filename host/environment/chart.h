// Maps the pixels of a layout to directions, and back.
#ifndef GLINT_ENVIRONMENT_CHART_H
#define GLINT_ENVIRONMENT_CHART_H

#include "base/status.h"
#include "base/vector.h"
#include "environment/layouts.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_FACE_EDGE_MAX 4096 // pixels; such a cube takes 1.6 GB

// A picture and the way it holds directions. Places are in pixels: (0, 0) is the picture's top left
// corner, and pixel (i, j) has its centre at (i + ½, j + ½).
typedef struct glint_chart {
    glint_layout layout;      // not UNKNOWN or STUDIO; FACES: six files, stacked vertically
    int width, height;        // pixels
    bool on_edges;            // CUBE, LATLONG: the outermost centres lie on edges and poles
    double center[2], radius; // BALL, ANGULAR: the disc; nothing lies outside
    // BALL: the viewer's distance from the ball's centre, in radii of the ball. It is over 1;
    // infinity is a viewer far away (orthographic).
    double distance;
} glint_chart;

// Makes the chart of a picture. `size` is in pixels: the edge of a face, or the height of a
// lat-long map or of a disc. A disc fills its picture. Fails with GLINT_USAGE if the size is too
// large or too small. (If the centres lie on the edges, the least size is 2.)
glint_status glint_chart_make(glint_layout layout, int size, bool on_edges, glint_chart *chart,
                              glint_error *error);

// The place of a cube's face in a picture of faces, in faces, and whether it is turned by 180°.
typedef struct glint_face_cell {
    int column, row;
    bool is_turned;
} glint_face_cell;

// The places of the six faces, in the order and orientation of kernels/layout.h. NULL if the layout
// is no cube. The whole picture has *across × *down faces; both pointers may be NULL.
const glint_face_cell *glint_layout_cells(glint_layout layout, int *across, int *down);

// A place in pixel (i, j): (dx, dy) pixels from its centre, at most half a pixel.
typedef struct glint_chart_place {
    int i, j;
    double dx, dy;
} glint_chart_place;

// Computes the direction of a place, not normalised. Returns false if the picture holds no
// direction there: beside a cross, outside a disc.
bool glint_chart_direction(const glint_chart *chart, const glint_chart_place *at,
                           glint_vec3 *direction);

// Computes the place where a disc shows a direction of any length but zero. Directions that a ball
// hides from its viewer are on its rim.
void glint_disc_place(const glint_chart *chart, glint_vec3 direction, double place[2]);

// The length in pixels of a small step from a direction, in radians across it. At the poles of a
// lat-long map and at a disc's rim the true length is unbounded; the function returns a finite
// value.
double glint_chart_pixels(const glint_chart *chart, glint_vec3 direction, glint_vec3 step);

// The pixels of a quarter turn where the layout is finest and steadiest: along the horizon, across
// a face, from a disc's centre. It makes charts of different layouts comparable.
double glint_chart_quarter_turn(const glint_chart *chart);

// The size (as in glint_chart_make) whose quarter turn takes this number of pixels, limited to the
// largest size of the layout.
int glint_chart_size_for(glint_layout layout, double quarter_turn);

#ifdef __cplusplus
}
#endif

#endif
