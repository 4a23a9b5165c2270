// Tests the statistics of measurements.
#include "base/statistics.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// A pseudo-random sequence, the same everywhere (Numerical Recipes' constants).
static double next_value(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 0x1p24;
}

static void known_rows_have_their_known_summaries(void **state)
{
    (void)state;
    double odd[] = {9, 1, 5, 3, 7};
    glint_summary s = glint_summarize(odd, 5);
    assert_int_equal(s.count, 5);
    assert_true(s.median == 5 && s.lower_quartile == 3 && s.upper_quartile == 7);
    assert_true(s.minimum == 1 && s.maximum == 9 && s.deviation == 2);
    double even[] = {4, 1, 3, 2};
    s = glint_summarize(even, 4);
    assert_true(s.median == 2.5 && s.lower_quartile == 1.75 && s.upper_quartile == 3.25);
    assert_true(s.deviation == 1); // of 1.5, 0.5, 0.5, 1.5
}

static void one_value_is_all_of_its_summary(void **state)
{
    (void)state;
    double one[] = {3.5};
    glint_summary s = glint_summarize(one, 1);
    assert_true(s.median == 3.5 && s.lower_quartile == 3.5 && s.upper_quartile == 3.5);
    assert_true(s.minimum == 3.5 && s.maximum == 3.5 && s.deviation == 0);
}

static void no_values_give_zeros(void **state)
{
    (void)state;
    glint_summary s = glint_summarize(NULL, 0);
    assert_true(s.count == 0 && s.median == 0 && s.maximum == 0 && s.deviation == 0);
}

static void one_outlier_moves_neither_median_nor_quartiles(void **state)
{
    (void)state;
    double plain[] = {10, 11, 12, 13, 14, 15, 16, 17, 18};
    double upset[] = {10, 11, 12, 13, 14, 15, 16, 17, 1e9};
    glint_summary a = glint_summarize(plain, 9), b = glint_summarize(upset, 9);
    assert_true(a.median == b.median && a.lower_quartile == b.lower_quartile);
    assert_true(a.upper_quartile == b.upper_quartile && a.deviation == b.deviation);
    assert_true(b.maximum == 1e9);
}

static double median_of(double *values, size_t count)
{
    glint_sort(values, count);
    return (values[(count - 1) / 2] + values[count / 2]) / 2;
}

// Compares the deviation, computed without another array, with its definition.
static void the_deviation_is_the_median_distance_from_the_median(void **state)
{
    (void)state;
    uint32_t seed = 7;
    for (size_t count = 1; count < 60; count++) {
        double values[60], distances[60];
        for (size_t i = 0; i < count; i++) {
            // A long tail, and ties.
            values[i] = floor(20 * pow(next_value(&seed), 3));
        }
        memcpy(distances, values, sizeof values);
        double median = median_of(distances, count);
        for (size_t i = 0; i < count; i++) {
            distances[i] = fabs(values[i] - median);
        }
        glint_summary s = glint_summarize(values, count);
        assert_true(s.median == median);
        assert_true(s.deviation == median_of(distances, count));
        assert_true(s.minimum <= s.lower_quartile && s.lower_quartile <= s.median);
        assert_true(s.median <= s.upper_quartile && s.upper_quartile <= s.maximum);
    }
}

static void quantiles_lie_on_the_line_between_neighbours(void **state)
{
    (void)state;
    const double values[] = {0, 10, 20, 40};
    assert_true(glint_quantile(values, 4, 0) == 0);
    assert_true(glint_quantile(values, 4, 1) == 40);
    assert_true(glint_quantile(values, 4, 0.5) == 15);
    assert_true(fabs(glint_quantile(values, 4, 0.9) - 34) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_rows_have_their_known_summaries),
        cmocka_unit_test(one_value_is_all_of_its_summary),
        cmocka_unit_test(no_values_give_zeros),
        cmocka_unit_test(one_outlier_moves_neither_median_nor_quartiles),
        cmocka_unit_test(the_deviation_is_the_median_distance_from_the_median),
        cmocka_unit_test(quantiles_lie_on_the_line_between_neighbours),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
