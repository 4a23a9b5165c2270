// How far a picture is from the one that it should be.
#ifndef GLINT_IMAGE_METRICS_H
#define GLINT_IMAGE_METRICS_H

#include "base/status.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A pixel differs visibly where R, G or B is off by more than this share of itself in the
// reference, or of the reference's mean, whichever is larger.
#define GLINT_METRICS_VISIBLE 0.01

// The largest component that PSNR is counted from: white.
#define GLINT_METRICS_PEAK 1.0

// Pixels with a component, alpha included, that is NaN, and with one that is infinite. A pixel with
// both counts twice.
typedef struct glint_defects {
    uint64_t nan, infinite;
} glint_defects;

// Over R, G and B of the pixels that are compared, but for alpha and the defects. Where no pixel is
// compared, all of the figures are 0.
typedef struct glint_metrics {
    uint64_t compared;    // pixels: R, G and B finite in both pictures, and not left out
    uint64_t nonfinite;   // pixels whose R, G or B is not finite, in either picture
    uint64_t differing;   // pixels that differ visibly
    double mean;          // of the reference, over all of its pixels that are finite in both
    double rmse;          // root of the mean square difference
    double relative_rmse; // rmse / |mean|; infinite where only the mean is 0
    double mae;           // mean of the absolute differences
    double psnr;          // 20 log10(GLINT_METRICS_PEAK / rmse), dB; infinite where rmse is 0
    double p99;           // of the pixels' largest differences, the 99th percentile
    double largest;       // of all differences
    // The first pixel, row by row, with that difference: its place, and R, G and B on both sides.
    // The first that is compared where all are equal.
    int worst_x, worst_y;
    float worst_image[3], worst_reference[3];
    // Largest difference of finite alphas over the compared pixels. A picture without alpha counts
    // as 1 everywhere.
    double alpha;
    // Of all pixels, also those that are left out: in the image, in the reference, in either.
    glint_defects in_image, in_reference, in_either;
} glint_metrics;

// Both pictures have one size; those with one or two channels are grey, R = G = B. `left_out` says
// which pixels are not compared ([height][width]); NULL: none. Errors: GLINT_USAGE where the
// pictures cannot be compared, GLINT_OUT_OF_MEMORY.
glint_status glint_metrics_find(const glint_image *image, const glint_image *reference,
                                const bool *left_out, glint_metrics *metrics, glint_error *error);

// Sets marks[i], [height][width], to whether pixel i is off by more than `tolerance`, counted as
// GLINT_METRICS_VISIBLE is, or not finite in either picture; returns how many are. The pictures are
// as above.
uint64_t glint_metrics_mark(const glint_image *image, const glint_image *reference,
                            double tolerance, bool *marks);

// The reference's mean, as in glint_metrics. The pictures are as above.
double glint_metrics_mean(const glint_image *image, const glint_image *reference);

// How far R, G and B of one pixel are off: image − reference. Zero where it is not finite.
typedef struct glint_pixel_error {
    bool is_finite;       // in both pictures
    double difference[3]; // as it is
    double relative[3];   // over |reference| or |mean|, whichever is larger; infinite if both are 0
    double absolute_most, relative_most; // the largest magnitudes of these
} glint_pixel_error;

// Of pixel `pixel`, counted row by row, where the reference's mean is `mean`.
glint_pixel_error glint_metrics_pixel(const glint_image *image, const glint_image *reference,
                                      size_t pixel, double mean);

#endif
