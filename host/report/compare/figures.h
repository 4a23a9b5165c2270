// The error figures under the names that people give them bounds by, and these bounds.
#ifndef GLINT_REPORT_COMPARE_FIGURES_H
#define GLINT_REPORT_COMPARE_FIGURES_H

#include "base/status.h"
#include "image/metrics.h"

#include <stdbool.h>

typedef enum glint_figure {
    GLINT_FIGURE_RMSE,
    GLINT_FIGURE_RELATIVE_RMSE,
    GLINT_FIGURE_MAE,
    GLINT_FIGURE_P99,
    GLINT_FIGURE_MAX,
    GLINT_FIGURE_PSNR,
    GLINT_FIGURE_DIFFERING, // share of the compared pixels that differ visibly
    GLINT_FIGURE_NAN,       // pixels with a NaN in either picture
    GLINT_FIGURE_INFINITE,  // the same with an infinity
    GLINT_FIGURE_ALPHA,
    GLINT_FIGURE_COUNT,
} glint_figure;

// "rmse", "relative-rmse", …; NULL at the end.
extern const char *const glint_figure_names[GLINT_FIGURE_COUNT + 1];

// Of psnr alone, which is bounded from below.
bool glint_figure_is_better_high(glint_figure figure);

double glint_figure_value(glint_figure figure, const glint_metrics *metrics);

// Zero is valid: no bounds. A limit belongs to the figure: the least for psnr, else the most.
typedef struct glint_bounds {
    bool is_set[GLINT_FIGURE_COUNT];
    double limit[GLINT_FIGURE_COUNT];
} glint_bounds;

bool glint_bounds_any(const glint_bounds *bounds);

// Where any bound is set, nan and infinite become 0 unless they are set: pixels that are left out
// of the other figures must not pass unseen.
void glint_bounds_complete(glint_bounds *bounds);

// Whether the figure keeps its bound, which is set. NaN keeps none, and nothing does where no pixel
// was compared.
bool glint_bound_is_kept(const glint_bounds *bounds, glint_figure figure,
                         const glint_metrics *metrics);

// GLINT_MISMATCH where a bound is not kept, with every such figure in the message: "IMAGE: rmse 0.2
// is above 0.1, … (REFERENCE)". The names are for the message.
glint_status glint_bounds_check(const glint_bounds *bounds, const glint_metrics *metrics,
                                const char *image, const char *reference, glint_error *error);

#endif
