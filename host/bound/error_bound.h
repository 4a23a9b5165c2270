// Frames whose error stays within a bound. For each, the cheapest way of rendering is taken whose
// error, measured on a sparse grid of the frame's own pixels against the reference of
// render/ladder.h, keeps the bound with a safety factor; what a grid cannot see is estimated, and
// what the whole frame truncated is looked at again when it has been rendered. Each frame is judged
// by itself. docs/max_error.md explains it to users.
#ifndef GLINT_BOUND_ERROR_BOUND_H
#define GLINT_BOUND_ERROR_BOUND_H

#include "base/status.h"
#include "environment/environment.h"
#include "render/frame.h"
#include "render/ladder.h"

#include <stdbool.h>

// What was chosen for a frame. Plain data.
typedef struct glint_error_choice {
    glint_rung rung;   // how the frame was rendered
    double bound;      // what was asked for
    double error;      // of the frame: relative RMSE against the reference, which is 0 of itself
    double grid_error; // as the grid showed it
    double unseen_of_float; // of `error`, what single precision is taken to add beyond what the
                            // grid showed; 0 in double precision
    int grid_pixels;        // that the error was measured on
    bool grid_is_frame;     // these were all there are: `error` is exact
    int grids;              // pictures of the grid that it took
    int frames;             // of the whole frame: 1, more where the first turned out not to keep it
    double choosing_ms;     // all that the frame took beside its last picture
    uint64_t choosing_rays; // the grid's
} glint_error_choice;

// What frames have in common. glint_error_bound_begin fills it.
typedef struct glint_error_bound {
    double bound;            // relative RMSE, > 0
    glint_settings settings; // of the renderer's creation
    double contrast;         // of the environment: how far radiances are from their mean over all
                             // directions, root mean square over R, G and B; what is not
                             // finite does not count
} glint_error_bound;

// `settings`: what glint_ladder_make wants, layers and directions being allowed, which are not
// looked at; they are what the renderer is made with.
void glint_error_bound_begin(glint_error_bound *bound, double max_error,
                             const glint_settings *settings);

// To be called for every environment before the frames that it lights.
void glint_error_bound_set_environment(glint_error_bound *bound, const glint_cube *environment);

// As glint_renderer_frame, but with the settings that keep the bound, which the renderer has
// afterwards; its layers are those of the frame, and so is the report, which must not be NULL.
// Errors: as glint_renderer_set_settings and glint_renderer_frame; GLINT_DEVICE_FAILED where the
// device has no double precision.
glint_status glint_error_bound_frame(const glint_error_bound *bound,
                                     const glint_frame_request *request, glint_error_choice *choice,
                                     glint_error *error);

#endif
