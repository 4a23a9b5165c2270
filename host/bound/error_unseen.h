// What single precision makes of a frame's pixels here and there, which a sparse grid of them does
// not show. For error_search.c only.
#ifndef GLINT_BOUND_ERROR_UNSEEN_H
#define GLINT_BOUND_ERROR_UNSEEN_H

#include "bound/error_search.h"

// In glass single precision is taken to add this at least: it errs by 1e-4 to 3e-4 where no pixel
// shows the other side of an edge (seven scenes).
#define GLINT_ERROR_FLOAT_IN_GLASS 2e-4

// Whether what is unseen of single precision, mended by so much (0: not at all), leaves room for
// anything else.
bool glint_error_may_be_float(const glint_error_search *search, double mend);

// A rung's error with what is unseen of it.
double glint_error_with_unseen(const glint_error_search *search, const glint_rung *rung,
                               double error);

// Adds what edges make of single precision where there is glass or a path meets a second surface,
// and finds by what to mend it.
// `image` is the grid by `settings`, whatever their precision. Errors, here and below: as
// glint_renderer_set_settings and glint_renderer_frame.
glint_status glint_error_find_edges(glint_error_search *search, const glint_image *image,
                                    const glint_settings *settings, glint_error *error);

// Whether long paths, of so many surfaces, may leave single precision without digits, and it
// matters.
bool glint_error_wants_chaos(const glint_error_search *search, uint32_t deepest);

// Adds what they make of it. `image` is the grid by `settings`, in double precision, its longest
// path `deepest`.
glint_status glint_error_find_chaos(glint_error_search *search, const glint_image *image,
                                    uint32_t deepest, const glint_settings *settings,
                                    glint_error *error);

#endif
