// Tests half floats: reading is exact, and every float becomes the nearest half. The reference
// counts units in the last place with the C library's rint.
#include "base/half.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// The value of a half by its definition: sign, 5 bits of exponent, 10 bits of fraction.
static double value_of(unsigned half)
{
    int exponent = (int)(half >> 10 & 31);
    double fraction = half & 1023;
    double value = exponent == 0    ? ldexp(fraction, -24)
                   : exponent == 31 ? (fraction > 0 ? NAN : INFINITY)
                                    : ldexp(1024 + fraction, exponent - 25);
    return half >> 15 ? -value : value;
}

// The half nearest to a finite value; rint rounds ties to even.
static double nearest_half(double value)
{
    int exponent;
    frexp(value, &exponent); // |value| in [2^(exponent − 1), 2^exponent)
    int last_place = exponent - 11 > -24 ? exponent - 11 : -24;
    double rounded = ldexp(rint(ldexp(value, -last_place)), last_place);
    return fabs(rounded) < 65536 ? rounded : copysign(INFINITY, value);
}

static void assert_rounds_to_nearest(float value)
{
    double expected = nearest_half((double)value);
    double got = value_of(glint_half_from_float(value));
    assert_true(got == expected);
    assert_true((signbit(got) != 0) == (signbit(value) != 0));
}

static void every_half_is_read_exactly_and_written_back(void **state)
{
    (void)state;
    for (unsigned half = 0; half < 65536; half++) {
        float read = glint_half_to_float((uint16_t)half);
        double expected = value_of(half);
        assert_true((signbit(read) != 0) == (half >> 15 != 0));
        if (isnan(expected)) {
            assert_true(isnan(read));
            assert_int_equal(glint_half_from_float(read), (half & 0x8000u) | GLINT_HALF_NAN);
        } else {
            assert_true((double)read == expected);
            assert_int_equal(glint_half_from_float(read), half);
        }
    }
}

// The middle between two neighbours, and the floats next to it.
static void ties_go_to_the_even_one(void **state)
{
    (void)state;
    for (unsigned half = 0; half < 0x7c00; half++) {
        // The neighbour above the largest half would be 2¹⁶.
        double above = half == 0x7bff ? 65536 : value_of(half + 1);
        float tie = (float)((value_of(half) + above) / 2); // exact: 12 bits
        for (int sign = 0; sign < 2; sign++) {
            float signed_tie = sign ? -tie : tie;
            unsigned even = half + (half & 1), bit = sign ? 0x8000 : 0;
            assert_int_equal(glint_half_from_float(signed_tie), even | bit);
            assert_int_equal(glint_half_from_float(nextafterf(signed_tie, 0)), half | bit);
            assert_int_equal(glint_half_from_float(nextafterf(signed_tie, sign ? -1e9f : 1e9f)),
                             (half + 1) | bit);
        }
    }
}

static void floats_of_all_sizes_become_the_nearest_half(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int i = 0; i < 2000000; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        uint32_t bits = (uint32_t)(random >> 32);
        // Half of the values lie between 2⁻²⁷ and 2¹⁷, the range of half; the others anywhere.
        if (i % 2 == 0) {
            bits = (bits & 0x807fffffu) | ((100u + (bits >> 23 & 0xffu) % 44u) << 23);
        }
        float value = glint_float_from_bits(bits);
        if (isfinite(value)) {
            assert_rounds_to_nearest(value);
        } else if (isnan(value)) {
            assert_int_equal(glint_half_from_float(value) & 0x7fff, GLINT_HALF_NAN);
        }
    }
}

static void the_ends_of_the_range_are_kept(void **state)
{
    (void)state;
    assert_int_equal(glint_half_from_float(0.0f), 0);
    assert_int_equal(glint_half_from_float(-0.0f), 0x8000);
    assert_int_equal(glint_half_from_float(INFINITY), GLINT_HALF_INFINITY);
    assert_int_equal(glint_half_from_float(-INFINITY), 0x8000 | GLINT_HALF_INFINITY);
    assert_int_equal(glint_half_from_float(GLINT_HALF_MAX), 0x7bff);
    assert_int_equal(glint_half_from_float(65519.996f), 0x7bff);
    assert_int_equal(glint_half_from_float(65520.0f), GLINT_HALF_INFINITY);
    assert_int_equal(glint_half_from_float(3e38f), GLINT_HALF_INFINITY);
    assert_int_equal(glint_half_from_float(0x1p-24f), 1);
    assert_int_equal(glint_half_from_float(0x1p-25f), 0); // a tie
    assert_int_equal(glint_half_from_float(0x1.000002p-25f), 1);
    assert_int_equal(glint_half_from_float(1e-45f), 0); // the smallest float
}

// Arrays may use other instructions, whose judge is the conversion of one value.
static void arrays_are_converted_like_single_values(void **state)
{
    (void)state;
    enum { COUNT = 1 << 16 };
    static uint16_t halfs[COUNT];
    static float floats[COUNT];
    for (unsigned half = 0; half < COUNT; half++) {
        halfs[half] = (uint16_t)half;
    }
    glint_halfs_to_floats(halfs, COUNT, floats);
    for (unsigned half = 0; half < COUNT; half++) {
        const float wanted = glint_half_to_float((uint16_t)half);
        assert_true(isnan(wanted) ? isnan(floats[half])
                                  : glint_float_bits(floats[half]) == glint_float_bits(wanted));
    }
    uint64_t random = 7;
    for (int round = 0; round < 32; round++) {
        for (int i = 0; i < COUNT; i++) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            floats[i] = glint_float_from_bits((uint32_t)(random >> 32));
        }
        glint_floats_to_halfs(floats, COUNT, halfs);
        for (int i = 0; i < COUNT; i++) {
            if (isnan(floats[i])) {
                assert_true(isnan(glint_half_to_float(halfs[i])));
            } else {
                assert_int_equal(halfs[i], glint_half_from_float(floats[i]));
            }
        }
    }
}

// Nothing is written beyond the end, whatever the number of values.
static void arrays_of_all_lengths_are_converted(void **state)
{
    (void)state;
    float floats[40];
    uint16_t halfs[40];
    for (size_t count = 0; count < 35; count++) {
        for (size_t i = 0; i < 40; i++) {
            floats[i] = (float)i;
            halfs[i] = 1;
        }
        glint_floats_to_halfs(floats, count, halfs);
        for (size_t i = 0; i < 40; i++) {
            assert_int_equal(halfs[i], i < count ? glint_half_from_float((float)i) : 1);
            floats[i] = -1;
        }
        glint_halfs_to_floats(halfs, count, floats);
        for (size_t i = 0; i < 40; i++) {
            assert_true(floats[i] == (i < count ? (float)i : -1.0f));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_half_is_read_exactly_and_written_back),
        cmocka_unit_test(ties_go_to_the_even_one),
        cmocka_unit_test(floats_of_all_sizes_become_the_nearest_half),
        cmocka_unit_test(the_ends_of_the_range_are_kept),
        cmocka_unit_test(arrays_are_converted_like_single_values),
        cmocka_unit_test(arrays_of_all_lengths_are_converted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
