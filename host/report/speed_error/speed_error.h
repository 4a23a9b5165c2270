// Measures speed against error: times every rung of a scene's ladder and compares its picture with
// a reference. docs/speed_error.md explains the results.
//
// The reference has the same samples as the frame. So these errors come from model and arithmetic
// alone. The error of sampling is measured separately: the default rung with more and more samples.
#ifndef GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_H
#define GLINT_REPORT_SPEED_ERROR_SPEED_ERROR_H

#include "image/image.h"
#include "render/ladder.h"
#include "report/bench/bench.h"

#include <stdbool.h>
#include <stdint.h>

// The error of the directions along which pixels see the environment, in degrees: the angle between
// the pixel's heaviest direction in both pictures. A pixel counts if its heaviest term is a look-up
// of radiance in both.
typedef struct glint_direction_error {
    uint64_t compared; // pixels
    double mean, p99, largest;
    uint64_t lost; // pixels whose heaviest term is such a look-up in only one of the pictures
} glint_direction_error;

// The results of one rung.
typedef struct glint_rung_result {
    glint_rung rung;
    glint_plan plan;
    // times before the first frame. Times of shared steps count in every rung; kernels, irradiance
    // and uploads count only in the rung that needed them first
    glint_phases phases;
    glint_summary kernel; // milliseconds per frame; all rungs take turns
    glint_ray_counts rays;
    glint_truncation truncation;
    glint_metrics error; // compared with the reference
    bool has_directions; // false: vertices were shaded; the next two members are zero
    glint_direction_error directions;
    // pixels whose middle primary ray meets another triangle than in the reference
    uint64_t wrong_hits;
    // a rung that is not slower and has no larger error, and is better in one of the two; −1: none
    int dominated_by;
    glint_image picture, heat; // empty without options.pictures
} glint_rung_result;

// The default rung with another number of samples per pixel, compared with very many samples.
typedef struct glint_sampling_result {
    int samples;
    bool is_mip; // true: mip filter; false: bilinear
    glint_summary kernel;
    glint_metrics error;
} glint_sampling_result;

#define GLINT_SAMPLING_ROWS 4

// The results of a scene.
typedef struct glint_speed_error_result {
    glint_capabilities device;
    glint_bvh_report bvh;
    glint_rung reference;
    glint_plan reference_plan;
    glint_summary reference_kernel; // milliseconds per frame, in turns with the rungs
    glint_truncation reference_truncation;
    // How much the reference changes if branches end at four times the weight, and if paths go
    // twice as deep. This shows about how accurate its own weights and depth are.
    glint_metrics change_by_weights, change_by_depth;
    glint_image reference_picture; // empty without options.pictures
    size_t count;
    glint_rung_result rungs[GLINT_RUNGS_MAX];
    int sampling_truth; // samples per pixel of the reference for `sampling`; 0: not measured
    glint_sampling_result sampling[GLINT_SAMPLING_ROWS];
} glint_speed_error_result;

// What to measure, and for how long.
typedef struct glint_speed_error_options {
    double seconds;   // measuring time per rung
    int rounds;       // frames of each rung; 0: `seconds` decides
    bool pictures;    // true: keep the pictures
    bool no_sampling; // true: do not measure the error of sampling
} glint_speed_error_options;

// Measures a scene. The settings must suit glint_ladder_make, with the bilinear filter and without
// layers. The device must have double precision. Free `result` with glint_speed_error_free, also
// after an error. Errors: as rendering; GLINT_DEVICE_LACKS without double precision;
// GLINT_INTERRUPTED.
glint_status glint_speed_error_measure(const glint_bench_inputs *inputs,
                                       const glint_speed_error_options *options,
                                       const glint_bench_watcher *watcher,
                                       glint_speed_error_result *result, glint_error *error);
void glint_speed_error_free(glint_speed_error_result *result);

// Sets `dominated_by` of each rung, by medians and relative RMSE. If several rungs dominate it,
// takes the fastest. A rung whose error is NaN, or with pixels that are not finite, is dominated by
// every rung without these faults.
void glint_speed_error_compare(glint_rung_result *rungs, size_t count);

// Compares the heaviest directions of two frames, both rendered with terms = 1.
glint_status glint_direction_error_find(const glint_layers *layers, const glint_layers *reference,
                                        size_t pixel_count, glint_direction_error *result,
                                        glint_error *error);

#endif
