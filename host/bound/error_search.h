// Searches for the cheapest settings whose error keeps a bound. The error is measured on a grid of
// the frame's own pixels, plus an estimate of the errors that a grid cannot see. For error_bound.c
// only.
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

// A rung that was tried, or the reference. For the reference, only `rung` and `is_reference` are
// set. Plain data.
typedef struct glint_error_trial {
    glint_rung rung;
    bool is_reference;
    glint_grid_error grid; // measured on the grid
    double error;          // upper estimate, with the errors that a grid cannot see
    double truncation;     // of the grid, see glint_truncation.rms
    uint64_t rays;         // of the grid
    uint32_t deepest;      // surfaces of the grid's longest path
} glint_error_trial;

#define GLINT_ERROR_RUNGS 9
#define GLINT_ERROR_SAFETY 1.05 // safety factor of the choice, in addition to chance

// The state of a search. The caller sets renderer, camera, progress and step of `grid`;
// glint_error_search_begin fills the rest. glint_error_search_end frees it.
typedef struct glint_error_search {
    const glint_error_bound *asked; // borrowed
    glint_error_grid grid;
    glint_settings of_reference; // of the grid
    glint_settings base;         // asked->settings, with lobes that keep the bound
    bool splits, glass, rough;   // paths split; the scene has glass; rough surfaces reflect lobes
    uint32_t deepest;            // surfaces of the longest path of the grid's reference
    uint64_t rays;               // of the grid's reference
    double truncation;           // of the grid's reference, see glint_truncation.rms
    // How much the light of another direction differs, as radiance.
    double contrast;
    double relative_contrast; // contrast / mean of the reference; 0 if the grid is the frame
    // The error that single precision is assumed to add beyond the error measured on the grid:
    // without mending, and with mending. `mend` is the limit (glint_settings.mend); 0 if mending
    // does not pay.
    double unseen, mended_unseen, mend;
    glint_image coarsest; // in double precision, with the largest weights that keep the bound
    glint_rung rungs[GLINT_ERROR_RUNGS]; // if paths do not split: in order of cost
    size_t count, taken;                 // number of rungs; index of the rung tried last
    size_t mended_rung;                  // index of the mended rung
} glint_error_search;

// Renders the grid's reference. `plan` is the plan of asked->settings. Errors: as
// glint_renderer_set_settings and glint_renderer_frame.
glint_status glint_error_search_begin(glint_error_search *search, const glint_error_bound *asked,
                                      const glint_plan *plan, glint_error *error);

// Chooses the cheapest rung that keeps the bound. Errors as above.
glint_status glint_error_search_choose(glint_error_search *search, glint_error_trial *trial,
                                       glint_error *error);

// Chooses a finer rung than *trial, whose frame had the error `estimate`. If the estimate is
// infinite, chooses the reference. Errors as above.
glint_status glint_error_search_refine(glint_error_search *search, double estimate,
                                       glint_error_trial *trial, glint_error *error);

// Chooses the reference, which keeps every bound.
void glint_error_search_give_up(const glint_error_search *search, glint_error_trial *trial);

// Estimates the error of a trial's frame from all of its pixels. Infinite if some pixels are not
// finite, unless the trial is the reference or the grid is the frame.
double glint_error_search_estimate(const glint_error_search *search, const glint_error_trial *trial,
                                   const glint_image *frame, const glint_frame_report *report);

void glint_error_search_end(glint_error_search *search);

#endif
