// Whether two programs made the same frame.
#ifndef GLINT_BENCH_AGREEMENT_H
#define GLINT_BENCH_AGREEMENT_H

#include "embree/reference.h"
#include "image/image.h"
#include "scenes.h"

#include <stdint.h>

// A pixel counts as different where a value is off by more than this share of the larger one.
#define BENCH_DIFFERENT 1e-2
// What is let pass. Along silhouettes rounding decides what a pixel sees, and each refraction
// magnifies rounding some ten times: of two million pixels 4 differ after one surface, 20 after
// two, 200 after three, 9,000 after four. A wrong formula, a shifted camera or a normal the wrong
// way round changes more than the limits after one. An OpenGL frame, in halves and with reflections
// that go into the surface, differs in 315 pixels.
#define BENCH_DIFFERENT_SHARE_MAX 0.001
#define BENCH_RELATIVE_RMSE_MAX 0.02
// So glass of depth 8 is judged by its frame of this depth; at depth 8 glint's own frames in float
// and in double differ as much as Embree's.
#define BENCH_JUDGED_DEPTH 3

typedef struct bench_agreement {
    double relative_rmse; // over R, G, B of all pixels, by the mean of glint's; of hits: of t
    uint64_t different_pixels;
    uint64_t pixels;
} bench_agreement;

// Colours: an image in RGBA against [height][width][4].
bench_agreement bench_compare_colors(const glint_image *glint, const float *other);

// Hits: an image of GLINT_OUTPUT_HITS against [height][width]. Where glint says that a point of a
// triangle is hit, Embree's point must be the same, whichever of two triangles that touch there it
// belongs to.
bench_agreement bench_compare_hits(const bench_scene *scene, const glint_image *glint,
                                   const embree_hit *embree);

// The worse of two in both figures.
bench_agreement bench_agreement_worse(bench_agreement a, bench_agreement b);

// GLINT_MISMATCH where the figures exceed the limits.
glint_status bench_check_agreement(const bench_agreement *agreement, const char *scene,
                                   const char *job, glint_error *error);

#endif
