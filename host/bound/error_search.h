// The search for the cheapest way of rendering a frame whose error on a grid of the frame's own
// pixels keeps a bound, with what a grid cannot see reckoned in. For error_bound.c only.
#ifndef GLINT_BOUND_ERROR_SEARCH_H
#define GLINT_BOUND_ERROR_SEARCH_H

#include "base/status.h"
#include "bound/error_bound.h"
#include "bound/error_grid.h"
#include "render/frame.h"
#include "render/ladder.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A rung that has been tried; or the reference, of which nothing is: only `rung` is set then. Plain
// data.
typedef struct glint_error_trial {
    glint_rung rung;
    bool is_reference;
    glint_grid_error grid; // as the grid showed it
    double error;          // at most, with what a grid cannot see
    double truncation;     // of the grid, see glint_truncation.rms
    uint64_t rays;         // of the grid
    uint32_t deepest;      // surfaces of the grid's longest path
} glint_error_trial;

#define GLINT_ERROR_RUNGS 9
#define GLINT_ERROR_SAFETY 1.05 // beside chance: what is chosen keeps the bound with it

// glint_error_search_begin fills it but for `grid`, of which renderer, camera, progress and step
// are the caller's, and glint_error_search_end frees it.
typedef struct glint_error_search {
    const glint_error_bound *asked; // borrowed
    glint_error_grid grid;
    glint_settings of_reference; // of the grid
    glint_settings base;         // asked->settings, with lobes that keep the bound
    bool splits, glass, rough;   // paths split; there is glass; lobes are seen
    uint32_t deepest;            // surfaces of the longest path of the grid's reference
    uint64_t rays;               // of the grid's reference
    double truncation;           // of the grid's reference, see glint_truncation.rms
    double contrast;             // by how much light from another direction differs, as radiance
    double relative_contrast;    // that over the reference's mean; 0 where the grid is the frame
    // What single precision is taken to add beyond what the grid shows; and mended, where that is
    // worth while, by so much (glint_settings.mend), else 0.
    double unseen, mended_unseen, mend;
    glint_image coarsest; // in double precision: by the largest weights that keep the bound
    glint_rung rungs[GLINT_ERROR_RUNGS]; // where paths do not split, in the order of what they cost
    size_t count, taken;                 // of the rungs; the one that was tried last
    size_t mended_rung;                  // which of them is mended
} glint_error_search;

// Renders the grid's reference. `plan` is that of asked->settings. Errors: as
// glint_renderer_set_settings and glint_renderer_frame.
glint_status glint_error_search_begin(glint_error_search *search, const glint_error_bound *asked,
                                      const glint_plan *plan, glint_error *error);

// The cheapest rung that keeps the bound. Errors as above.
glint_status glint_error_search_choose(glint_error_search *search, glint_error_trial *trial,
                                       glint_error *error);

// A finer rung than *trial, whose frame turned out to err by `estimate`; the reference where that
// is infinite. Errors as above.
glint_status glint_error_search_refine(glint_error_search *search, double estimate,
                                       glint_error_trial *trial, glint_error *error);

// The reference, which keeps every bound.
void glint_error_search_give_up(const glint_error_search *search, glint_error_trial *trial);

// What the frame of a trial errs by, from all of its pixels: infinite where some are not finite
// that nothing is known of.
double glint_error_search_estimate(const glint_error_search *search, const glint_error_trial *trial,
                                   const glint_image *frame, const glint_frame_report *report);

void glint_error_search_end(glint_error_search *search);

#endif
