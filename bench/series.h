// Collects and summarises the times of rounds.
#ifndef GLINT_BENCH_SERIES_H
#define GLINT_BENCH_SERIES_H

#define BENCH_ROUNDS_MAX 1000

// Milliseconds, one for each round.
typedef struct bench_series {
    int count;
    double ms[BENCH_ROUNDS_MAX];
} bench_series;

// NaN for an empty series.
typedef struct bench_summary {
    double median, min, max;
} bench_summary;

void bench_series_add(bench_series *series, double ms);

bench_summary bench_summarize(const bench_series *series);

// Summarises the ratios round by round. Both series have the same length.
bench_summary bench_summarize_ratio(const bench_series *above, const bench_series *below);

#endif
