// Speed against error: every rung of a scene's ladder timed, and its picture held against the
// reference's. docs/speed_error.md explains what comes of it.
//
// The reference has the frame's own samples, so that what is measured is the error of model and
// arithmetic; the error of sampling is told apart, of the default rung with more and more samples.
#ifndef GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_H
#define GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_H

#include "image/image.h"
#include "render/ladder.h"
#include "report/bench/bench.h"

#include <stdbool.h>
#include <stdint.h>

// How far the directions are off along which pixels see the environment: of those pixels whose
// heaviest look-up is one of radiance in both pictures, the angles between the two. Degrees.
typedef struct glint_direction_error {
    uint64_t compared; // pixels
    double mean, p99, largest;
    uint64_t lost; // pixels that have such a look-up in one of the pictures alone
} glint_direction_error;

typedef struct glint_rung_result {
    glint_rung rung;
    glint_plan plan;
    glint_phases phases;  // before the first frame; what it shares with others counts in each, but
                          // kernels, irradiance and uploads where they were made
    glint_summary kernel; // of its frames, milliseconds, in turns with all the others'
    glint_ray_counts rays;
    glint_truncation truncation;
    glint_metrics error; // against the reference
    bool has_directions; // else the next two are zero: vertices were shaded
    glint_direction_error directions;
    uint64_t wrong_hits; // pixels whose primary ray, of the one in the middle, meets another
                         // triangle than the reference's
    int dominated_by; // a rung that is no slower and errs no more, one of them better; −1: none
    glint_image picture, heat; // where pictures are wanted, else empty
} glint_rung_result;

// The default rung with other numbers of samples a pixel, against very many.
typedef struct glint_sampling_result {
    int samples;
    bool is_mip; // the filter
    glint_summary kernel;
    glint_metrics error;
} glint_sampling_result;

#define GLINT_SAMPLING_ROWS 4

typedef struct glint_speed_error_result {
    glint_capabilities device;
    glint_bvh_report bvh;
    glint_rung reference;
    glint_plan reference_plan;
    glint_summary reference_kernel; // of its frames, in turns with the rungs'
    glint_truncation reference_truncation;
    // What becomes of it where branches end at four times the weight, and where paths go twice as
    // deep: about what its own weights and depth are good for.
    glint_metrics change_by_weights, change_by_depth;
    glint_image reference_picture; // where pictures are wanted
    size_t count;
    glint_rung_result rungs[GLINT_RUNGS_MAX];
    int sampling_truth; // samples a pixel of what the next are held against; 0: left out
    glint_sampling_result sampling[GLINT_SAMPLING_ROWS];
} glint_speed_error_result;

typedef struct glint_speed_error_options {
    double seconds;   // a rung's share of the time that is measured
    int rounds;       // 0: by the time; else so many frames of each rung
    bool pictures;    // keep them
    bool no_sampling; // leave its rows out
} glint_speed_error_options;

// Measures. The settings are as glint_ladder_make wants them, with the bilinear filter and no
// layers; the device must have double precision. `result` is the caller's to free, whatever comes
// of it. Errors: as rendering gives; GLINT_DEVICE_FAILED without double precision;
// GLINT_INTERRUPTED.
glint_status glint_speed_error_measure(const glint_bench_inputs *inputs,
                                       const glint_speed_error_options *options,
                                       const glint_bench_watcher *watcher,
                                       glint_speed_error_result *result, glint_error *error);
void glint_speed_error_free(glint_speed_error_result *result);

// Sets `dominated_by` of each rung, by medians and relative RMSE: of several that dominate it the
// fastest. A rung whose error is NaN, or with pixels that are not finite, is dominated by any that
// has neither.
void glint_speed_error_compare(glint_rung_result *rungs, size_t count);

// How far the heaviest directions differ of two frames that were rendered with terms = 1.
glint_status glint_direction_error_find(const glint_layers *layers, const glint_layers *reference,
                                        size_t pixel_count, glint_direction_error *result,
                                        glint_error *error);

#endif
