// Converts between float and half (IEEE 754's binary16). A half has 11 significant bits and
// exponents from −14 to 15. Below 2⁻¹⁴ it holds multiples of 2⁻²⁴ (denormal). The functions
// for one value are plain C, because not every processor has an instruction for the conversion.
#ifndef GLINT_BASE_HALF_H
#define GLINT_BASE_HALF_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

#define GLINT_HALF_MAX 65504.0f

#define GLINT_HALF_DROPPED 13 // mantissa bits that a half drops: it keeps 10 of a float's 23
#define GLINT_HALF_REBIAS ((127u - 15u) << 23) // difference of the biases, in a float's exponent
#define GLINT_HALF_INFINITY 0x7c00u
#define GLINT_HALF_NAN 0x7e00u

static inline uint32_t glint_float_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline float glint_float_from_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// Returns the half nearest to `value`; a tie goes to the half whose last bit is 0. Values from
// 65520 on become ∞. The sign is kept, also that of zero; a NaN becomes a quiet NaN.
static inline uint16_t glint_half_from_float(float value)
{
    const uint32_t least_normal = 0x38800000u, too_large = 0x47800000u; // 2⁻¹⁴ and 2¹⁶
    const uint32_t infinity = 0x7f800000u, half = 0x3f000000u;          // ∞ and ½
    uint32_t magnitude = glint_float_bits(value) & 0x7fffffffu;
    uint32_t sign = glint_float_bits(value) >> 16 & 0x8000u;
    // Add a little under half of the last place, or exactly half if the last bit is 1. A carry
    // rounds up, into the exponent too.
    uint32_t almost_half = (1u << (GLINT_HALF_DROPPED - 1)) - 1;
    uint32_t last_bit = magnitude >> GLINT_HALF_DROPPED & 1;
    uint32_t normal =
        (magnitude - GLINT_HALF_REBIAS + almost_half + last_bit) >> GLINT_HALF_DROPPED;
    // The last place of a sum with ½ is 2⁻²⁴, so the addition itself rounds.
    uint32_t denormal = glint_float_bits(glint_float_from_bits(magnitude) + 0.5f) - half;
    uint32_t special = magnitude > infinity ? GLINT_HALF_NAN : GLINT_HALF_INFINITY;
    uint32_t finite = magnitude < least_normal ? denormal : normal;
    return (uint16_t)(sign | (magnitude < too_large ? finite : special));
}

// Converts exactly.
static inline float glint_half_to_float(uint16_t half)
{
    uint32_t magnitude = half & 0x7fffu;
    uint32_t sign = (half & 0x8000u) << 16;
    // ∞ and NaN have the largest exponent, in a half and in a float.
    uint32_t rebias = magnitude < GLINT_HALF_INFINITY ? GLINT_HALF_REBIAS : 2 * GLINT_HALF_REBIAS;
    uint32_t normal = (magnitude << GLINT_HALF_DROPPED) + rebias;
    uint32_t denormal = glint_float_bits((float)(int32_t)magnitude * 0x1p-24f);
    return glint_float_from_bits(sign | (magnitude < 0x400u ? denormal : normal));
}

// Converts an array exactly.
void glint_halfs_to_floats(const uint16_t *halfs, size_t count, float *floats);

// Converts an array as glint_half_from_float does. A NaN may keep more of its bits.
void glint_floats_to_halfs(const float *floats, size_t count, uint16_t *halfs);

#ifdef __cplusplus
}
#endif

#endif
