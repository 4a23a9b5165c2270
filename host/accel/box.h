// Axis-aligned boxes for the builder. They are vectors of four floats, so that two maxima grow a
// box.
#ifndef GLINT_ACCEL_BOX_H
#define GLINT_ACCEL_BOX_H

#include <math.h>
#include <stdint.h>
#include <string.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

// x, y, z, and a fourth lane that boxes do not use.
typedef float glint_float4 __attribute__((vector_size(16)));
typedef int32_t glint_int4 __attribute__((vector_size(16)));

// The low corner is stored negated, so that both corners grow by a maximum.
typedef struct glint_box {
    glint_float4 low_negated, high;
} glint_box;

// Returns a > b ? a : b in each lane.
static inline glint_float4 glint_larger4(glint_float4 a, glint_float4 b)
{
#ifdef __SSE__
    return _mm_max_ps(a, b);
#else
    for (int k = 0; k < 4; k++) {
        b[k] = a[k] > b[k] ? a[k] : b[k];
    }
    return b;
#endif
}

static inline glint_box glint_box_empty(void)
{
    const glint_float4 nothing = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    return (glint_box){nothing, nothing};
}

static inline glint_box glint_box_union(glint_box a, glint_box b)
{
    return (glint_box){glint_larger4(a.low_negated, b.low_negated), glint_larger4(a.high, b.high)};
}

// Returns low + high, twice the centre.
static inline glint_float4 glint_box_middle(glint_box b)
{
    return b.high - b.low_negated;
}

// Returns a point as a box.
static inline glint_box glint_box_of(glint_float4 point)
{
    return (glint_box){-point, point};
}

static inline float glint_box_extent(glint_box b)
{
    glint_float4 size = b.high + b.low_negated;
    return fmaxf(size[0], fmaxf(size[1], size[2]));
}

// A factor that keeps the areas of boxes of this extent clear of overflow and underflow.
static inline float glint_box_scale(glint_box b)
{
    float scale = 1 / glint_box_extent(b);
    return isfinite(scale) ? scale : 0;
}

// Half of the surface area of a box that is not empty, its sides multiplied by `scale`.
static inline float glint_box_area(glint_box b, float scale)
{
    glint_float4 size = (b.high + b.low_negated) * scale;
    return size[0] * size[1] + (size[0] + size[1]) * size[2];
}

#endif
