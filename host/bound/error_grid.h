// Pictures of a sparse grid of a frame's pixels, and their errors. For error_search.c only.
#ifndef GLINT_BOUND_ERROR_GRID_H
#define GLINT_BOUND_ERROR_GRID_H

#include "render/frame.h"

#include <stddef.h>
#include <stdint.h>

// Zero is valid; glint_error_grid_free frees the pictures.
typedef struct glint_error_grid {
    glint_renderer *renderer;       // borrowed
    const glint_camera *camera;     // likewise
    const glint_progress *progress; // likewise; may be NULL. It is asked whether to go on, and told
                                    // nothing of how far it is
    glint_image reference;
    glint_image image;            // the last one that was measured
    double mean;                  // the reference's
    double *jumps;                // of its pixels, see below: in squares of the mean
    const glint_image *in_double; // of the grid, what mended pixels are taken to be; borrowed
    int step;                     // of the grid; 1: it is the frame
    int pictures;                 // so far
    uint64_t rays;                // likewise
    glint_frame_report report;    // of the last one
} glint_error_grid;

// About so many pixels are a grid's; a frame of less than so many is its own grid.
#define GLINT_ERROR_GRID_PIXELS 5000
#define GLINT_ERROR_GRID_WHOLE 36000

// The step of the grid of a frame.
int glint_error_grid_step(int width, int height);

// Renders the grid's pixels with `settings`, but for their grid_step and extras, as the reference.
// Errors, here and below: as glint_renderer_set_settings and glint_renderer_frame.
glint_status glint_error_grid_set_reference(glint_error_grid *grid, const glint_settings *settings,
                                            glint_error *error);

// How far the reference's pixels are from their mean, root mean square over R, G and B; pixels that
// are not finite do not count.
double glint_error_grid_contrast(const glint_error_grid *grid);

// Over the pixels that are finite in the reference. Plain data.
typedef struct glint_grid_error {
    double measured;   // relative RMSE; infinite where the picture is not finite
    double at_most;    // what that is at most over the whole frame, as far as a grid can tell, with
                       // a confidence of 97.5%
    double mean_error; // the picture's mean less the reference's
} glint_grid_error;

// Renders the grid as above, and compares it to its reference. What of it would be mended is taken
// to be as in_double is, where edges have been found.
glint_status glint_error_grid_measure(glint_error_grid *grid, const glint_settings *settings,
                                      glint_grid_error *result, glint_error *error);

// Takes the picture that was measured last into *image, whose own memory is used for the next one.
void glint_error_grid_keep(glint_error_grid *grid, glint_image *image);

// What edges are looked for in. Pointers are borrowed.
typedef struct glint_error_edges {
    const glint_image *image; // of the grid
    const glint_settings
        *settings;  // that make about the same, in the precision that is asked about
    double allowed; // of what is left of them in a mended frame
} glint_error_edges;

// What a frame in single precision errs by, relative to the reference's mean, as its light jumps at
// edges and folds and a sample here and there shows the other side: at most, with a confidence of
// some 95% and as far as the grid has seen such jumps. Plain data.
typedef struct glint_edge_errors {
    double at_most;
    double mend;   // glint_settings.mend with which it is no more than what is allowed
    double mended; // at most with that
} glint_edge_errors;

// Jumps are where a pixel is not the mean of itself with the camera a little to the right and up
// and as much to the left and down; how often one is taken on the wrong side follows from what
// single precision is off by. The grid keeps them for what follows.
glint_status glint_error_grid_find_edges(glint_error_grid *grid, const glint_error_edges *edges,
                                         glint_edge_errors *result, glint_error *error);

// How many rays mending the frame takes, about, of so many as the grid's pixels take each: renders
// those of them that would be mended, with `settings`.
glint_status glint_error_grid_count_mended(glint_error_grid *grid, const glint_settings *settings,
                                           double mend, double *rays, glint_error *error);

// What chaos is looked for in. Pointers are borrowed.
typedef struct glint_error_chaos {
    const glint_image *image;       // of the grid by `settings`, in double precision
    const glint_settings *settings; // likewise
    int depth;                      // surfaces after which it may begin
    double contrast;                // how far light from another direction is off
} glint_error_chaos;

// How much of the grid hangs on digits that single precision does not have: of the pixels whose
// light beyond `depth` surfaces matters (by a hundredth of the mean), how far each is from the mean
// of itself with the camera a thousandth of a pixel to the left and to the right, in parts of
// `contrast` and one at most; the mean over all pixels. That is how likely a jump is met, which
// counts in full. Where it is less than a hundredth, light is taken to change steeply but without
// jumps, and its square counts. What changes evenly with the camera is not counted: rounding shifts
// paths by less than that, and the grid shows what comes of it.
glint_status glint_error_grid_find_chaos(glint_error_grid *grid, const glint_error_chaos *chaos,
                                         double *share, glint_error *error);

size_t glint_error_grid_pixel_count(const glint_error_grid *grid);

void glint_error_grid_free(glint_error_grid *grid);

#endif
