// Draws a plot of errors against times, as SVG within a page (page_style.h has its colours).
#ifndef GLINT_REPORT_SPEED_ERROR_PAGE_PLOT_H
#define GLINT_REPORT_SPEED_ERROR_PAGE_PLOT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// A point of the plot.
typedef struct glint_plot_point {
    double ms, error; // plotted if ms > 0 and error ≥ 0; NaN leaves the point out
    double low, high; // quartiles of the time
    bool is_optimal;
    const char *label; // tooltip
    const char *link;  // "#s1r3"
} glint_plot_point;

// Draws the points with numbers from 1, in their order. Both axes are logarithmic; errors of 0 lie
// on their own line at the bottom. A stepped line joins the optimal points: the least error within
// each time.
void glint_page_plot(const glint_plot_point *points, size_t count, FILE *out);

#endif
