// Renders a sparse grid of a frame's pixels, and measures the errors of its pictures. For
// error_search.c only.
#ifndef GLINT_BOUND_ERROR_GRID_H
#define GLINT_BOUND_ERROR_GRID_H

#include "render/frame.h"

#include <stddef.h>
#include <stdint.h>

// Zero is valid; glint_error_grid_free frees the pictures.
typedef struct glint_error_grid {
    glint_renderer *renderer;   // borrowed
    const glint_camera *camera; // borrowed
    // Borrowed, may be NULL. It is asked whether to continue, but gets no progress.
    const glint_progress *progress;
    glint_image reference;
    glint_image image; // the picture that was measured last
    double mean;       // mean of the reference
    // Squared jumps of the grid's pixels (see below), in squares of the mean.
    double *jumps;
    // The grid in double precision: mended pixels are assumed to have its values. Borrowed.
    const glint_image *in_double;
    int step;                  // step of the grid; 1: the grid is the frame
    int pictures;              // pictures rendered so far
    uint64_t rays;             // rays traced so far
    glint_frame_report report; // report of the last picture
} glint_error_grid;

// A grid has about GRID_PIXELS pixels. A frame with fewer than GRID_WHOLE pixels is its own grid.
#define GLINT_ERROR_GRID_PIXELS 5000
#define GLINT_ERROR_GRID_WHOLE 36000

// The step of a frame's grid: it takes every step-th pixel of every step-th row.
int glint_error_grid_step(int width, int height);

// Renders the grid with `settings` as the reference. The grid replaces their grid_step and extras
// (layers, terms). Errors, here and below: as glint_renderer_set_settings and glint_renderer_frame.
glint_status glint_error_grid_set_reference(glint_error_grid *grid, const glint_settings *settings,
                                            glint_error *error);

// The deviation of the reference's pixels from their mean, as root mean square over R, G and B.
// Pixels that are not finite do not count.
double glint_error_grid_contrast(const glint_error_grid *grid);

// The error of a picture of the grid, over the pixels that are finite in the reference. Plain data.
typedef struct glint_grid_error {
    double measured; // relative RMSE; infinite if the picture is not finite
    // Upper bound of the relative RMSE of the whole frame, as far as a grid can tell, with a
    // confidence of 97.5%.
    double at_most;
    double mean_error; // mean of the picture − mean of the reference
} glint_grid_error;

// Renders the grid as above and compares it with its reference. If edges have been found, pixels
// that the frame would mend count with their value of in_double.
glint_status glint_error_grid_measure(glint_error_grid *grid, const glint_settings *settings,
                                      glint_grid_error *result, glint_error *error);

// Moves the picture that was measured last into *image. The next picture reuses the old memory of
// *image.
void glint_error_grid_keep(glint_error_grid *grid, glint_image *image);

// The inputs for finding edges. Pointers are borrowed.
typedef struct glint_error_edges {
    const glint_image *image; // a picture of the grid
    // Settings that render about the same picture, in the precision in question.
    const glint_settings *settings;
    double allowed; // allowed error that edges leave in a mended frame
} glint_error_edges;

// Errors of a frame in single precision at edges and folds, relative to the reference's mean. The
// light jumps there, and a few samples show the wrong side. The errors are upper bounds with a
// confidence of about 95%, as far as the grid has seen such jumps. Plain data.
typedef struct glint_edge_errors {
    double at_most;
    double mend;   // glint_settings.mend that keeps the allowed error
    double mended; // upper bound with this mending
} glint_edge_errors;

// Finds jumps. A pixel has a jump if it differs from the mean of two pictures: one with the camera
// shifted a little to the right and up, one with the opposite shift. The error of single precision
// tells how often a sample falls on the wrong side. The grid keeps the jumps for later calls.
glint_status glint_error_grid_find_edges(glint_error_grid *grid, const glint_error_edges *edges,
                                         glint_edge_errors *result, glint_error *error);

// Estimates the rays that mending takes, in rays of the grid. Renders those pixels of the grid that
// would be mended, with `settings`.
glint_status glint_error_grid_count_mended(glint_error_grid *grid, const glint_settings *settings,
                                           double mend, double *rays, glint_error *error);

// The inputs for finding chaos. Pointers are borrowed.
typedef struct glint_error_chaos {
    const glint_image *image;       // the grid rendered with `settings`, in double precision
    const glint_settings *settings; // settings of `image`
    int depth;                      // surfaces after which chaos may begin
    double contrast;                // deviation of the light of another direction
} glint_error_chaos;

// Finds the share of the grid that depends on digits that single precision does not have. Only
// pixels count whose light beyond `depth` surfaces matters (more than a hundredth of the mean).
// Each is compared with the mean of two pictures, whose cameras are shifted by a thousandth of a
// pixel to the left and to the right. The difference in units of `contrast`, at most 1, is the
// likelihood of a jump, and counts in full. Below a hundredth, the light is assumed to change
// steeply but without jumps, and the square counts. *share is the mean over all pixels of the grid.
// Light that changes evenly with the camera does not count: rounding shifts paths by less, and the
// grid shows the effect.
glint_status glint_error_grid_find_chaos(glint_error_grid *grid, const glint_error_chaos *chaos,
                                         double *share, glint_error *error);

size_t glint_error_grid_pixel_count(const glint_error_grid *grid);

void glint_error_grid_free(glint_error_grid *grid);

#endif
