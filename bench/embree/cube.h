// Looks up the Embree program's environment: finds the place of a direction in the cube map of
// kernels/layout.h and interpolates bilinearly.
#ifndef GLINT_BENCH_EMBREE_CUBE_H
#define GLINT_BENCH_EMBREE_CUBE_H

#include "embree/lanes.h"

#include "environment/environment.h"
#include "kernels/layout.h"

#include <stdint.h>

// Returns the index of the upper left of the four texels. *right and the lower weight, in [0, 1),
// are the offsets of the point towards the right and the lower texels.
static inline ints find_on_cube(reals3 d, int edge, reals *right, reals *down)
{
    reals ax = absolute(d.x), ay = absolute(d.y), az = absolute(d.z);
    ints x_major = (ax >= ay) & (ax >= az);
    ints y_major = ~x_major & (ay >= az);
    reals major = choose(x_major, ax, choose(y_major, ay, az));
    ints negative = choose(x_major, d.x, choose(y_major, d.y, d.z)) < 0.0f;
    reals s_x = choose(negative, -d.z, d.z), s_z = choose(negative, d.x, -d.x);
    reals s = choose(x_major, s_x, choose(y_major, d.x, s_z));
    reals t = choose(y_major, choose(negative, d.z, -d.z), -d.y);
    ints face = choose_int(x_major, int_of(0), choose_int(y_major, int_of(2), int_of(4)));
    face -= negative; // a true lane is −1

    const float half = (float)edge * 0.5f;
    const int pitch = edge + 2 * GLINT_CUBE_BORDER;
    reals scaled = half * reciprocal(major);
    reals column = s * scaled + (half + 0.5f), row = t * scaled + (half + 0.5f);
    ints i = __builtin_convertvector(column, ints), j = __builtin_convertvector(row, ints);
    *right = column - __builtin_convertvector(i, reals);
    *down = row - __builtin_convertvector(j, reals);
    return (face * pitch + j) * pitch + i;
}

// One look-up in a map of float texels.
static inline quad sample_floats(const glint_cube *cube, int texel, float right, float down)
{
    const float *upper = cube->texels + 4 * (size_t)texel;
    const float *lower = upper + 4 * ((size_t)cube->edge + 2 * GLINT_CUBE_BORDER);
    quad top_left = *(const quad *)upper, top_right = *(const quad *)(upper + 4);
    quad bottom_left = *(const quad *)lower, bottom_right = *(const quad *)(lower + 4);
    quad top = top_left + right * (top_right - top_left);
    quad bottom = bottom_left + right * (bottom_right - bottom_left);
    return top + down * (bottom - top);
}

#define PAIR_HALVES 8 // a texel and the texel below it

#ifdef __AVX512F__

// Copies the values of lanes 4 g … 4 g + 3, each to the four lanes of its pixel.
static inline reals spread_group(reals values, int group)
{
    const __m512i zero_to_three = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    __m512i lanes = _mm512_add_epi32(zero_to_three, _mm512_set1_epi32(4 * group));
    return (reals)_mm512_permutexvar_ps(lanes, (__m512)values);
}

// Four look-ups in pairs of half texels, for lanes 4 g … 4 g + 3. Each result is R G B A.
static inline reals sample_halves(const uint16_t *pairs, const int *texels, reals right, reals down,
                                  int group)
{
    __m512 t[4]; // one register a pixel: upper left, lower left, upper right, lower right
    for (int k = 0; k < 4; k++) {
        const uint16_t *at = pairs + PAIR_HALVES * (size_t)texels[4 * group + k];
        t[k] = _mm512_cvtph_ps(_mm256_loadu_si256((const __m256i *)at));
    }
    // Transpose the 4 × 4 quarters.
    __m512 left_01 = _mm512_shuffle_f32x4(t[0], t[1], 0x44);
    __m512 left_23 = _mm512_shuffle_f32x4(t[2], t[3], 0x44);
    __m512 right_01 = _mm512_shuffle_f32x4(t[0], t[1], 0xee);
    __m512 right_23 = _mm512_shuffle_f32x4(t[2], t[3], 0xee);
    reals upper_left = (reals)_mm512_shuffle_f32x4(left_01, left_23, 0x88);
    reals lower_left = (reals)_mm512_shuffle_f32x4(left_01, left_23, 0xdd);
    reals upper_right = (reals)_mm512_shuffle_f32x4(right_01, right_23, 0x88);
    reals lower_right = (reals)_mm512_shuffle_f32x4(right_01, right_23, 0xdd);
    reals across = spread_group(right, group), along = spread_group(down, group);
    reals left_edge = upper_left + along * (lower_left - upper_left);
    reals right_edge = upper_right + along * (lower_right - upper_right);
    return left_edge + across * (right_edge - left_edge);
}

// `to` is aligned to 64 bytes.
static inline void stream(float *to, reals values)
{
    _mm512_stream_ps(to, (__m512)values);
}

#else

static inline reals sample_halves(const uint16_t *pairs, const int *texels, reals right, reals down,
                                  int group)
{
    reals result;
    for (int k = 0; k < 4; k++) {
        const __m128i *at = (const __m128i *)(pairs + PAIR_HALVES * (size_t)texels[4 * group + k]);
        __m256 left_pair = _mm256_cvtph_ps(_mm_loadu_si128(at));
        __m256 right_pair = _mm256_cvtph_ps(_mm_loadu_si128(at + 1));
        __m256 across = _mm256_set1_ps(right[4 * group + k]);
        __m256 both =
            _mm256_add_ps(left_pair, _mm256_mul_ps(across, _mm256_sub_ps(right_pair, left_pair)));
        quad upper = (quad)_mm256_castps256_ps128(both);
        quad lower = (quad)_mm256_extractf128_ps(both, 1);
        quad color = upper + down[4 * group + k] * (lower - upper);
        memcpy((float *)&result + 4 * k, &color, sizeof color);
    }
    return result;
}

static inline void stream(float *to, reals values)
{
    for (int k = 0; k < 4; k++) {
        quad part;
        memcpy(&part, (const float *)&values + 4 * k, sizeof part);
        _mm_stream_ps(to + 4 * k, (__m128)part);
    }
}

#endif

#endif
