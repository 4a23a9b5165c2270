// Computes median, quartiles and range. See statistics.h.
#include "base/statistics.h"

#include <math.h>
#include <stdlib.h>

static int compare(const void *first, const void *second)
{
    double a = *(const double *)first, b = *(const double *)second;
    return (a > b) - (a < b);
}

void glint_sort(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare);
}

double glint_quantile(const double *ascending, size_t count, double q)
{
    double position = q * (double)(count - 1);
    size_t below = (size_t)position;
    size_t above = below + 1 < count ? below + 1 : below;
    double share = position - (double)below;
    return ascending[below] + share * (ascending[above] - ascending[below]);
}

// The k-th smallest distance from `centre`, k from 0, of values in ascending order. Distances grow
// outwards from the centre, so two indices merge them without another array.
static double kth_distance(const double *ascending, size_t count, double centre, size_t k)
{
    size_t right = 0;
    while (right < count && ascending[right] < centre) {
        right++;
    }
    size_t left = right; // values left of here are below the centre and not yet taken
    double distance = 0;
    for (size_t taken = 0; taken <= k; taken++) {
        double below = left > 0 ? centre - ascending[left - 1] : INFINITY;
        double above = right < count ? ascending[right] - centre : INFINITY;
        distance = fmin(below, above);
        if (below <= above) {
            left--;
        } else {
            right++;
        }
    }
    return distance;
}

glint_summary glint_summarize(double *values, size_t count)
{
    if (count == 0) {
        return (glint_summary){0};
    }
    glint_sort(values, count);
    double median = glint_quantile(values, count, 0.5);
    return (glint_summary){
        .count = count,
        .median = median,
        .lower_quartile = glint_quantile(values, count, 0.25),
        .upper_quartile = glint_quantile(values, count, 0.75),
        .minimum = values[0],
        .maximum = values[count - 1],
        .deviation = (kth_distance(values, count, median, (count - 1) / 2) +
                      kth_distance(values, count, median, count / 2)) /
                     2,
    };
}
