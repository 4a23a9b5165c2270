// Computes with sixteen values at a time, in GCC's vectors, for the Embree program. Comparisons
// give masks: −1 for true and 0 for false in each lane. With AVX-512 a vector is one register. On
// other machines the compiler splits it, with the same code here.
#ifndef GLINT_BENCH_EMBREE_LANES_H
#define GLINT_BENCH_EMBREE_LANES_H

#include <immintrin.h>
#include <string.h>

#define LANES 16

typedef float reals __attribute__((vector_size(4 * LANES), may_alias));
typedef int ints __attribute__((vector_size(4 * LANES), may_alias));
typedef float quad __attribute__((vector_size(16), may_alias)); // R, G, B, A

typedef struct reals3 {
    reals x, y, z;
} reals3;

static inline reals real_of(float x)
{
    return (reals){0} + x;
}

static inline ints int_of(int x)
{
    return (ints){0} + x;
}

// Compiles to one masked move.
static inline reals choose(ints mask, reals yes, reals no)
{
    return (reals)((mask & (ints)yes) | (~mask & (ints)no));
}

static inline ints choose_int(ints mask, ints yes, ints no)
{
    return (mask & yes) | (~mask & no);
}

static inline reals3 choose3(ints mask, reals3 yes, reals3 no)
{
    return (reals3){choose(mask, yes.x, no.x), choose(mask, yes.y, no.y),
                    choose(mask, yes.z, no.z)};
}

// Sets bit i where lane i of the mask is true.
static inline unsigned bits_of(ints mask)
{
#ifdef __AVX512F__
    return _mm512_cmplt_epi32_mask((__m512i)mask, _mm512_setzero_si512());
#else
    unsigned bits = 0;
    for (int lane = 0; lane < LANES; lane++) {
        bits |= (unsigned)(mask[lane] & 1) << lane;
    }
    return bits;
#endif
}

static inline reals load(const float *from)
{
    return *(const reals *)from;
}

static inline void store(float *to, reals values)
{
    *(reals *)to = values;
}

static inline reals absolute(reals x)
{
    return (reals)((ints)x & 0x7fffffff);
}

static inline reals larger(reals a, reals b)
{
    return choose(a > b, a, b);
}

static inline reals smaller(reals a, reals b)
{
    return choose(a < b, a, b);
}

static inline reals square_root(reals x)
{
#ifdef __AVX512F__
    return (reals)_mm512_sqrt_ps((__m512)x);
#else
    for (int lane = 0; lane < LANES; lane++) {
        x[lane] = __builtin_sqrtf(x[lane]);
    }
    return x;
#endif
}

// 1/x within two units in the last place: a 14-bit estimate and one Newton step.
static inline reals reciprocal(reals x)
{
#ifdef __AVX512F__
    reals estimate = (reals)_mm512_rcp14_ps((__m512)x);
    return estimate * (2.0f - x * estimate);
#else
    return 1.0f / x;
#endif
}

// 1/√x within two units in the last place, by the same method.
static inline reals inverse_root(reals x)
{
#ifdef __AVX512F__
    reals estimate = (reals)_mm512_rsqrt14_ps((__m512)x);
    return estimate * (1.5f - 0.5f * x * estimate * estimate);
#else
    return 1.0f / square_root(x);
#endif
}

static inline reals dot(reals3 a, reals3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline reals3 scale(reals3 a, reals s)
{
    return (reals3){a.x * s, a.y * s, a.z * s};
}

// a s + b
static inline reals3 scale_add(reals3 a, reals s, reals3 b)
{
    return (reals3){a.x * s + b.x, a.y * s + b.y, a.z * s + b.z};
}

static inline reals3 negate(reals3 a)
{
    return (reals3){-a.x, -a.y, -a.z};
}

#endif
