// How far a picture is from the one that it should be.
#ifndef GLINT_REPORT_METRICS_H
#define GLINT_REPORT_METRICS_H

#include "base/status.h"
#include "image/image.h"

#include <stdbool.h>
#include <stdint.h>

// A pixel differs visibly where R, G or B is off by more than this share of itself in the
// reference, or of the reference's mean, whichever is larger.
#define GLINT_METRICS_VISIBLE 0.01

// Over R, G and B of the pixels that are compared; alpha is not looked at.
typedef struct glint_metrics {
    uint64_t compared;    // pixels: finite in both pictures, and not left out
    uint64_t nonfinite;   // pixels with a component that is not finite, in either picture
    uint64_t differing;   // pixels that differ visibly
    double mean;          // of the reference, over all of its pixels that are finite in both
    double rmse;          // root of the mean square difference
    double relative_rmse; // rmse / mean; infinite where only the mean is 0
    double p99;           // of the pixels' largest differences, the 99th percentile
    double largest;       // of all differences
} glint_metrics;

// Both pictures have one size and at least three channels. `left_out` says which pixels are not
// compared ([height][width]); NULL: none. Errors: GLINT_USAGE where the pictures cannot be
// compared, GLINT_DEVICE_FAILED (memory).
glint_status glint_metrics_find(const glint_image *image, const glint_image *reference,
                                const bool *left_out, glint_metrics *metrics, glint_error *error);

// Sets marks[i], [height][width], to whether pixel i is off by more than `tolerance`, counted as
// GLINT_METRICS_VISIBLE is, or not finite in either picture; returns how many are. The pictures are
// as above.
uint64_t glint_metrics_mark(const glint_image *image, const glint_image *reference,
                            double tolerance, bool *marks);

#endif
