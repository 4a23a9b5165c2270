// Defines the oracle's own vectors: three doubles by value, for directions, points and colours.
#ifndef GLINT_ORACLE_VECTOR_H
#define GLINT_ORACLE_VECTOR_H

#include <math.h>

typedef struct vector {
    double at[3];
} vector;

static inline vector vector_of(const double components[3])
{
    return (vector){{components[0], components[1], components[2]}};
}

static inline void vector_store(vector a, double components[3])
{
    for (int i = 0; i < 3; i++)
        components[i] = a.at[i];
}

static inline vector plus(vector a, vector b)
{
    return (vector){{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]}};
}

static inline vector minus(vector a, vector b)
{
    return (vector){{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
}

static inline vector scaled(vector a, double s)
{
    return (vector){{a.at[0] * s, a.at[1] * s, a.at[2] * s}};
}

// Multiplies componentwise, for colours.
static inline vector times(vector a, vector b)
{
    return (vector){{a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2]}};
}

static inline double dot(vector a, vector b)
{
    return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}

// cross(a, b) = −cross(b, a) to the last bit (without contraction): shared edges rely on it.
static inline vector cross(vector a, vector b)
{
    return (vector){{a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
                     a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

static inline double length(vector a)
{
    return sqrt(dot(a, a));
}

static inline double largest(vector a)
{
    return fmax(a.at[0], fmax(a.at[1], a.at[2]));
}

static inline double largest_magnitude(vector a)
{
    return fmax(fabs(a.at[0]), fmax(fabs(a.at[1]), fabs(a.at[2])));
}

// The unit vector along a. Divides by the largest component first, so the squares of 10⁻²⁰⁰ and
// 10²⁰⁰ stay in range. The zero vector gives NaN.
static inline vector unit(vector a)
{
    vector b = scaled(a, 1.0 / largest_magnitude(a));
    return scaled(b, 1.0 / length(b));
}

#endif
