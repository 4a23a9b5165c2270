// Estimates errors of single precision in rare pixels, which a sparse grid does not show. For
// error_search.c only.
#ifndef GLINT_BOUND_ERROR_UNSEEN_H
#define GLINT_BOUND_ERROR_UNSEEN_H

#include "bound/error_search.h"

// The least error that single precision is assumed to add in glass. Its error is 1e-4 to 3e-4 even
// if no pixel shows the wrong side of an edge (seven scenes).
#define GLINT_ERROR_FLOAT_IN_GLASS 2e-4

// True if the unseen error of single precision leaves room in the bound for other errors. `mend` as
// in glint_settings.mend; 0: without mending.
bool glint_error_may_be_float(const glint_error_search *search, double mend);

// Adds the unseen error of the rung to `error`.
double glint_error_with_unseen(const glint_error_search *search, const glint_rung *rung,
                               double error);

// If there is glass or if paths meet a second surface, adds the error of single precision at edges
// to the unseen error. Finds the limit for mending. `image` is the grid rendered with `settings`,
// in any precision. Errors, here and below: as glint_renderer_set_settings and
// glint_renderer_frame.
glint_status glint_error_find_edges(glint_error_search *search, const glint_image *image,
                                    const glint_settings *settings, glint_error *error);

// True if paths of `deepest` surfaces may leave no correct digits in single precision, and if that
// affects the choice.
bool glint_error_wants_chaos(const glint_error_search *search, uint32_t deepest);

// Adds the error of these long paths to the unseen error. `image` is the grid rendered with
// `settings` in double precision; `deepest` is the number of surfaces of its longest path.
glint_status glint_error_find_chaos(glint_error_search *search, const glint_image *image,
                                    uint32_t deepest, const glint_settings *settings,
                                    glint_error *error);

#endif
