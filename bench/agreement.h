// Compares the frames of two programs, so that a contest times equal work.
#ifndef GLINT_BENCH_AGREEMENT_H
#define GLINT_BENCH_AGREEMENT_H

#include "embree/reference.h"
#include "image/image.h"
#include "scenes.h"

#include <stdint.h>

// A pixel differs if a value is off by more than this share of the larger value.
#define BENCH_DIFFERENT 1e-2
// Limits of the comparison. Along silhouettes rounding decides what a pixel sees, and each
// refraction magnifies rounding about ten times. Of two million pixels 4 differ after one surface,
// 20 after two, 200 after three, 9,000 after four. A wrong formula, a shifted camera or a reversed
// normal exceeds the limits after one surface. An OpenGL frame with half texels, whose reflections
// may go into the surface, differs in 315 pixels.
#define BENCH_DIFFERENT_SHARE_MAX 0.001
#define BENCH_RELATIVE_RMSE_MAX 0.02
// Glass of depth 8 is therefore compared at this depth. At depth 8 glint's own frames in float and
// in double differ as much as Embree's.
#define BENCH_JUDGED_DEPTH 3

typedef struct bench_agreement {
    // RMSE of R, G, B over all pixels, relative to glint's mean; for hits: RMSE of t.
    double relative_rmse;
    uint64_t different_pixels;
    uint64_t pixels;
} bench_agreement;

// Compares colours: an RGBA image with an array [height][width][4].
bench_agreement bench_compare_colors(const glint_image *glint, const float *other);

// Compares hits: an image of GLINT_OUTPUT_HITS with an array [height][width]. If glint hits a point
// of a triangle, Embree must hit the same point. Either triangle counts where two touch.
bench_agreement bench_compare_hits(const bench_scene *scene, const glint_image *glint,
                                   const embree_hit *embree);

// The worse value of each figure.
bench_agreement bench_agreement_worse(bench_agreement a, bench_agreement b);

// Fails with GLINT_MISMATCH if a figure exceeds its limit.
glint_status bench_check_agreement(const bench_agreement *agreement, const char *scene,
                                   const char *job, glint_error *error);

#endif
