// Measures the difference between a picture and its reference.
#ifndef GLINT_IMAGE_METRICS_H
#define GLINT_IMAGE_METRICS_H

#include "base/status.h"
#include "image/image.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A pixel differs visibly if the error of R, G or B exceeds this share of the reference's own
// value, or of the reference's mean, whichever is larger.
#define GLINT_METRICS_VISIBLE 0.01

// The peak of PSNR: white.
#define GLINT_METRICS_PEAK 1.0

// Counts of pixels with a NaN and of pixels with an infinite component, alpha included. A pixel
// with both counts twice.
typedef struct glint_defects {
    uint64_t nan, infinite;
} glint_defects;

// Figures over R, G and B of the compared pixels, except for `alpha` and the defects. They are 0 if
// no pixel is compared.
typedef struct glint_metrics {
    uint64_t compared;    // pixels not left out, with finite R, G and B in both pictures
    uint64_t nonfinite;   // pixels whose R, G or B is not finite, in either picture
    uint64_t differing;   // pixels that differ visibly
    double mean;          // mean of the reference, over its pixels finite in both pictures
    double rmse;          // root of the mean square difference
    double relative_rmse; // rmse / |mean|; infinite if only the mean is 0
    double mae;           // mean of the absolute differences
    double psnr;          // 20 log10(GLINT_METRICS_PEAK / rmse), dB; infinite if rmse is 0
    double p99;           // 99th percentile of the pixels' largest differences
    double largest;       // largest of all differences
    // The first pixel, row by row, with the largest difference: its place, and its R, G and B in
    // both pictures. If all pixels are equal, it is the first compared pixel.
    int worst_x, worst_y;
    float worst_image[3], worst_reference[3];
    // Largest difference of finite alphas over the compared pixels. A picture without alpha has
    // alpha 1.
    double alpha;
    // Defects of all pixels, also of those left out: in the image, in the reference, in either.
    glint_defects in_image, in_reference, in_either;
} glint_metrics;

// Both pictures have one size. A picture with one or two channels is grey, R = G = B. `left_out`
// marks the pixels that are not compared ([height][width]); NULL: none. Errors: GLINT_USAGE if the
// pictures cannot be compared, GLINT_OUT_OF_MEMORY.
glint_status glint_metrics_find(const glint_image *image, const glint_image *reference,
                                const bool *left_out, glint_metrics *metrics, glint_error *error);

// Marks pixels in `marks`, [height][width]. It marks a pixel whose error exceeds `tolerance`,
// measured as GLINT_METRICS_VISIBLE is, or that is not finite in either picture. Returns the number
// of marks. Pictures: as above.
uint64_t glint_metrics_mark(const glint_image *image, const glint_image *reference,
                            double tolerance, bool *marks);

// The reference's mean, as in glint_metrics. Pictures: as above.
double glint_metrics_mean(const glint_image *image, const glint_image *reference);

// The error of R, G and B of one pixel: image − reference. Zero if the pixel is not finite.
typedef struct glint_pixel_error {
    bool is_finite;       // in both pictures
    double difference[3]; // signed, not relative
    double relative[3];   // over |reference| or |mean|, the larger; infinite if both are 0
    double absolute_most, relative_most; // largest magnitudes
} glint_pixel_error;

// Measures pixel number `pixel`, counted row by row. `mean` is the reference's mean.
glint_pixel_error glint_metrics_pixel(const glint_image *image, const glint_image *reference,
                                      size_t pixel, double mean);

#endif
