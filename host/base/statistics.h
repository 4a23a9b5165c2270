// What a row of measurements comes to, without assuming how they are distributed: times of frames
// have a hard lower end and a long tail.
#ifndef GLINT_BASE_STATISTICS_H
#define GLINT_BASE_STATISTICS_H

#include <stddef.h>

// In the unit of the values. All are 0 where there are none.
typedef struct glint_summary {
    size_t count;
    double median;
    double lower_quartile, upper_quartile;
    double minimum, maximum;
    double deviation; // the median of the distances from the median (MAD)
} glint_summary;

// The summary of `count` finite values, which are put in ascending order.
glint_summary glint_summarize(double *values, size_t count);

// The quantile q in [0, 1] of `count` ≥ 1 values in ascending order: the value at position q (count
// − 1), between two neighbours by linear interpolation (Hyndman and Fan 1996, definition 7).
double glint_quantile(const double *ascending, size_t count, double q);

// Puts `count` values in ascending order. No NaN.
void glint_sort(double *values, size_t count);

#endif
