// Names the error figures of a comparison, and checks bounds on them.
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
    GLINT_FIGURE_INFINITE,  // pixels with an infinity in either picture
    GLINT_FIGURE_ALPHA,
    GLINT_FIGURE_COUNT,
} glint_figure;

// "rmse", "relative-rmse", …; NULL at the end.
extern const char *const glint_figure_names[GLINT_FIGURE_COUNT + 1];

// True only for psnr: a larger value is better, so its bound is a minimum.
bool glint_figure_is_better_high(glint_figure figure);

double glint_figure_value(glint_figure figure, const glint_metrics *metrics);

// Bounds on figures. Zero is valid: no bounds. The limit is a minimum for psnr, else a maximum.
typedef struct glint_bounds {
    bool is_set[GLINT_FIGURE_COUNT];
    double limit[GLINT_FIGURE_COUNT];
} glint_bounds;

bool glint_bounds_any(const glint_bounds *bounds);

// If any bound is set, bounds nan and infinite by 0 unless they have a bound. The other figures
// skip these pixels, so this keeps them from being overlooked.
void glint_bounds_complete(glint_bounds *bounds);

// True if the figure keeps its bound, which must be set. NaN keeps no bound. If no pixel was
// compared, no bound is kept.
bool glint_bound_is_kept(const glint_bounds *bounds, glint_figure figure,
                         const glint_metrics *metrics);

// Checks all bounds. Returns GLINT_MISMATCH if one is broken; the message lists all broken ones:
// "IMAGE: rmse 0.2 is above 0.1, … (REFERENCE)". The names are only for the message.
glint_status glint_bounds_check(const glint_bounds *bounds, const glint_metrics *metrics,
                                const char *image, const char *reference, glint_error *error);

#endif
