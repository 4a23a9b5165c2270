// Collects and summarises the times of rounds. See series.h.
#include "series.h"

#include <math.h>
#include <stdlib.h>

void bench_series_add(bench_series *series, double ms)
{
    series->ms[series->count++] = ms;
}

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

bench_summary bench_summarize(const bench_series *series)
{
    bench_series sorted = *series;
    const int n = sorted.count;
    if (n == 0) {
        return (bench_summary){NAN, NAN, NAN};
    }
    qsort(sorted.ms, (size_t)n, sizeof *sorted.ms, compare_numbers);
    double median = 0.5 * (sorted.ms[(n - 1) / 2] + sorted.ms[n / 2]);
    return (bench_summary){median, sorted.ms[0], sorted.ms[n - 1]};
}

bench_summary bench_summarize_ratio(const bench_series *above, const bench_series *below)
{
    bench_series ratio = {.count = below->count};
    for (int i = 0; i < ratio.count; i++) {
        ratio.ms[i] = above->ms[i] / below->ms[i];
    }
    return bench_summarize(&ratio);
}
