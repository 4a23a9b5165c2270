// Makes pseudorandom numbers that are the same on every machine (Steele, Lea and Flood, Fast
// splittable pseudorandom number generators, 2014).
#ifndef GLINT_BASE_RANDOM_H
#define GLINT_BASE_RANDOM_H

#include "base/vector.h"

#include <math.h>
#include <stdint.h>

typedef struct glint_random {
    uint64_t state; // any value
} glint_random;

// A number in [0, 1).
static inline double glint_random_number(glint_random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// A direction, distributed evenly over the unit sphere.
static inline glint_vec3 glint_random_direction(glint_random *random)
{
    double y = 2 * glint_random_number(random) - 1;
    double azimuth = 2 * GLINT_PI * glint_random_number(random);
    double ring = sqrt(1 - y * y);
    const glint_vec3 direction = {ring * cos(azimuth), y, ring * sin(azimuth)};
    return direction;
}

#endif
