// Renders frames whose error stays within a bound. For each frame, glint takes the cheapest
// settings whose error keeps the bound with a safety factor. It measures the error on a sparse grid
// of the frame's own pixels, against the reference of render/ladder.h. It estimates the errors that
// a grid cannot see. After rendering, it checks the truncation of the whole frame again. Each frame
// is judged by itself. docs/max_error.md explains this to users.
#ifndef GLINT_BOUND_ERROR_BOUND_H
#define GLINT_BOUND_ERROR_BOUND_H

#include "base/status.h"
#include "environment/environment.h"
#include "render/frame.h"
#include "render/ladder.h"

#include <stdbool.h>

// The settings chosen for a frame, and its error. Plain data.
typedef struct glint_error_choice {
    glint_rung rung;   // how the frame was rendered
    double bound;      // the requested bound
    double error;      // estimate for the frame: relative RMSE against the reference; 0 for the
                       // reference itself
    double grid_error; // measured on the grid
    // The part of `error` that single precision is assumed to add beyond the error measured on the
    // grid. 0 in double precision.
    double unseen_of_float;
    int grid_pixels;        // pixels that the error was measured on
    bool grid_is_frame;     // the grid holds all pixels, so `error` is exact
    int grids;              // renderings of the grid
    int frames;             // renderings of the whole frame: 1, or more if the first exceeded the
                            // bound
    double choosing_ms;     // time of everything except the last rendering of the frame
    uint64_t choosing_rays; // rays of the grid
} glint_error_choice;

// The data that all frames share. glint_error_bound_begin fills it.
typedef struct glint_error_bound {
    double bound;            // relative RMSE, > 0
    glint_settings settings; // with which the renderer was created
    // Contrast of the environment: the deviation of the radiance from its mean over all directions,
    // as root mean square over R, G and B. Radiances that are not finite do not count.
    double contrast;
} glint_error_bound;

// Begins with the settings that the renderer was created with. They must suit glint_ladder_make,
// but may ask for layers and directions, which the error does not consider.
void glint_error_bound_begin(glint_error_bound *bound, double max_error,
                             const glint_settings *settings);

// Sets the environment. Call it for every environment, before the frames that it lights.
void glint_error_bound_set_environment(glint_error_bound *bound, const glint_cube *environment);

// Renders a frame like glint_renderer_frame, with the cheapest settings that keep the bound. The
// renderer keeps these settings afterwards. Its layers and the report are those of the frame; the
// report must not be NULL. Errors: as glint_renderer_set_settings and glint_renderer_frame;
// GLINT_DEVICE_LACKS if the device has no double precision.
glint_status glint_error_bound_frame(const glint_error_bound *bound,
                                     const glint_frame_request *request, glint_error_choice *choice,
                                     glint_error *error);

#endif
