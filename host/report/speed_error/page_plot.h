// A plot of errors against times, as SVG within a page (page_style.h has its colours).
#ifndef GLINT_REPORT_SPEED_ERROR_PAGE_PLOT_H
#define GLINT_REPORT_SPEED_ERROR_PAGE_PLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct glint_plot_point {
    double ms, error; // > 0; 0 and more, or NaN: left out
    double low, high; // quartiles of the time
    bool is_optimal;
    const char *label; // what the pointer shows
    const char *link;  // "#s1r3"
} glint_plot_point;

// Points get their numbers, from 1, in their order. Both axes are logarithmic; errors of 0 stand on
// a line of their own below. The optimal ones are joined by steps: what is reached by then.
void glint_page_plot(const glint_plot_point *points, size_t count, FILE *out);

#endif
