// Summarizes a series of measurements without assuming a distribution. Frame times, for example,
// have a hard lower end and a long tail.
#ifndef GLINT_BASE_STATISTICS_H
#define GLINT_BASE_STATISTICS_H

#include <stddef.h>

// In the unit of the values. All members are 0 if there are no values.
typedef struct glint_summary {
    size_t count;
    double median;
    double lower_quartile, upper_quartile;
    double minimum, maximum;
    double deviation; // the median of the distances from the median (MAD)
} glint_summary;

// Returns the summary of `count` finite values and sorts them in ascending order.
glint_summary glint_summarize(double *values, size_t count);

// Returns the quantile q in [0, 1] of `count` ≥ 1 values in ascending order. This is the value at
// position q (count − 1), interpolated linearly between its two neighbours (Hyndman and Fan 1996,
// definition 7).
double glint_quantile(const double *ascending, size_t count, double q);

// Sorts `count` values in ascending order. No value is NaN.
void glint_sort(double *values, size_t count);

#endif
