// Converts arrays between float and half. See half.h.
#include "base/half.h"

#if defined(__x86_64__)
#include <immintrin.h>

#define LANES 8

// Every processor with AVX2 has these conversions. (Not every compiler knows "f16c" in
// __builtin_cpu_supports.)
static int has_conversions(void)
{
    return __builtin_cpu_supports("avx2");
}

__attribute__((target("avx,f16c"))) static size_t widen(const uint16_t *halfs, size_t count,
                                                        float *floats)
{
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        _mm256_storeu_ps(floats + i,
                         _mm256_cvtph_ps(_mm_loadu_si128((const __m128i *)(halfs + i))));
    }
    return i;
}

__attribute__((target("avx,f16c"))) static size_t narrow(const float *floats, size_t count,
                                                         uint16_t *halfs)
{
    size_t i = 0;
    for (; i + LANES <= count; i += LANES) {
        _mm_storeu_si128((__m128i *)(halfs + i),
                         _mm256_cvtps_ph(_mm256_loadu_ps(floats + i), _MM_FROUND_TO_NEAREST_INT));
    }
    return i;
}

#else

static int has_conversions(void)
{
    return 0;
}

static size_t widen(const uint16_t *halfs, size_t count, float *floats)
{
    (void)halfs, (void)count, (void)floats;
    return 0;
}

static size_t narrow(const float *floats, size_t count, uint16_t *halfs)
{
    (void)floats, (void)count, (void)halfs;
    return 0;
}

#endif

void glint_halfs_to_floats(const uint16_t *halfs, size_t count, float *floats)
{
    for (size_t i = has_conversions() ? widen(halfs, count, floats) : 0; i < count; i++) {
        floats[i] = glint_half_to_float(halfs[i]);
    }
}

void glint_floats_to_halfs(const float *floats, size_t count, uint16_t *halfs)
{
    for (size_t i = has_conversions() ? narrow(floats, count, halfs) : 0; i < count; i++) {
        halfs[i] = glint_half_from_float(floats[i]);
    }
}
