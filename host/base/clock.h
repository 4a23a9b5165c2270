// Measures time.
#ifndef GLINT_BASE_CLOCK_H
#define GLINT_BASE_CLOCK_H

#include <time.h>

// Returns milliseconds on the monotonic clock, from an arbitrary start.
static inline double glint_now_ms(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

// Returns the milliseconds since *start and sets *start to now.
static inline double glint_lap_ms(double *start)
{
    const double now = glint_now_ms(), elapsed = now - *start;
    *start = now;
    return elapsed;
}

#endif
