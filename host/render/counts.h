// Counts a frame's rays and the light that it truncates.
#ifndef GLINT_RENDER_COUNTS_H
#define GLINT_RENDER_COUNTS_H

#include <stdint.h>

// Rays traced or looked up, by origin. The last direction of a path counts even if it was only
// looked up in the environment.
typedef struct glint_ray_counts {
    uint64_t primary;
    uint64_t reflected;
    uint64_t refracted_in;      // into a solid
    uint64_t refracted_out;     // out of a solid
    uint64_t transmitted;       // straight through a thin wall
    uint64_t shadow;            // to lights; a shadow ray that passes through surfaces counts once
    uint64_t total_reflections; // of `reflected`, those by total internal reflection
} glint_ray_counts;

void glint_ray_counts_add(glint_ray_counts *sum, const glint_ray_counts *more);

// The number of all rays, traced or looked up.
uint64_t glint_ray_counts_all(const glint_ray_counts *rays);

// Truncated light: light that took the environment along its last direction without tracing it. A
// share of all weight (1 = every sample of every pixel, largest of R, G and B).
typedef struct glint_truncation {
    double by_depth;
    double by_min_weight;
    double by_stack;
    // Root mean square of the pixels' truncated weights, if the settings ask for
    // truncation_squares. Truncation by depth does not count if the depth is the reference's (see
    // ladder.h) or is proved to be exact.
    double rms;
    // Entries lost because solids nest deeper than the stack of media.
    uint64_t media_overflows;
} glint_truncation;

// The truncated share of all weight, for any reason.
double glint_truncation_total(const glint_truncation *truncation);

#endif
