// Adds up the counts of frames. See counts.h.
#include "render/counts.h"

void glint_ray_counts_add(glint_ray_counts *sum, const glint_ray_counts *more)
{
    sum->primary += more->primary;
    sum->reflected += more->reflected;
    sum->refracted_in += more->refracted_in;
    sum->refracted_out += more->refracted_out;
    sum->transmitted += more->transmitted;
    sum->shadow += more->shadow;
    sum->total_reflections += more->total_reflections;
}

uint64_t glint_ray_counts_all(const glint_ray_counts *rays)
{
    // `reflected` includes total reflections.
    return rays->primary + rays->reflected + rays->refracted_in + rays->refracted_out +
           rays->transmitted + rays->shadow;
}

double glint_truncation_total(const glint_truncation *truncation)
{
    return truncation->by_depth + truncation->by_min_weight + truncation->by_stack;
}
