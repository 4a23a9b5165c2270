// Defines vectors of three doubles for the cases of the self-test.
#ifndef GLINT_SELFTEST_VECTORS_H
#define GLINT_SELFTEST_VECTORS_H

#include <math.h>

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double product[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        product[k] = a[i] * b[j] - a[j] * b[i];
    }
}

// Scales to length 1.
static inline void make_unit(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

static inline double distance(const double a[3], const double b[3])
{
    const double away[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(dot(away, away));
}

// x if it is above 0, else 0. NaN stays NaN; fmax() would drop it.
static inline double above_zero(double x)
{
    return x <= 0 ? 0 : x;
}

#endif
