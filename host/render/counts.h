// What a frame counts: its rays, and the light that it was cut short of.
#ifndef GLINT_RENDER_COUNTS_H
#define GLINT_RENDER_COUNTS_H

#include <stdint.h>

// Rays traced or looked up, by how they came about. A path's last direction counts even where it
// was only looked up in the environment.
typedef struct glint_ray_counts {
    uint64_t primary;
    uint64_t reflected;
    uint64_t refracted_in;      // into a solid
    uint64_t refracted_out;     // out of a solid
    uint64_t transmitted;       // straight through a thin wall
    uint64_t shadow;            // to lights; surfaces that let light pass count no more
    uint64_t total_reflections; // of `reflected`, those by total internal reflection
} glint_ray_counts;

void glint_ray_counts_add(glint_ray_counts *sum, const glint_ray_counts *more);

// All rays that were traced or looked up.
uint64_t glint_ray_counts_all(const glint_ray_counts *rays);

// Light that took the environment along its last direction without that direction being traced, as
// a share of all weight (1 = every sample of every pixel, largest of R, G and B).
typedef struct glint_truncation {
    double by_depth;
    double by_min_weight;
    double by_stack;
    double rms; // of pixels' truncated weight, its root mean square, where the settings ask for
                // truncation_squares; without what the depth truncates where that is the
                // reference's (see ladder.h) or proved to be exact
    uint64_t media_overflows; // entries lost because solids nest deeper than the stack of media
} glint_truncation;

// The share of all weight that was truncated, for whatever reason.
double glint_truncation_total(const glint_truncation *truncation);

#endif
