// Names the error figures, and checks bounds on them. See figures.h.
#include "report/compare/figures.h"

#include <stdio.h>
#include <string.h>

const char *const glint_figure_names[GLINT_FIGURE_COUNT + 1] = {
    [GLINT_FIGURE_RMSE] = "rmse",
    [GLINT_FIGURE_RELATIVE_RMSE] = "relative-rmse",
    [GLINT_FIGURE_MAE] = "mae",
    [GLINT_FIGURE_P99] = "p99",
    [GLINT_FIGURE_MAX] = "max",
    [GLINT_FIGURE_PSNR] = "psnr",
    [GLINT_FIGURE_DIFFERING] = "differing",
    [GLINT_FIGURE_NAN] = "nan",
    [GLINT_FIGURE_INFINITE] = "infinite",
    [GLINT_FIGURE_ALPHA] = "alpha",
};

bool glint_figure_is_better_high(glint_figure figure)
{
    return figure == GLINT_FIGURE_PSNR;
}

double glint_figure_value(glint_figure figure, const glint_metrics *metrics)
{
    const double compared = (double)metrics->compared;
    const double values[GLINT_FIGURE_COUNT] = {
        [GLINT_FIGURE_RMSE] = metrics->rmse,
        [GLINT_FIGURE_RELATIVE_RMSE] = metrics->relative_rmse,
        [GLINT_FIGURE_MAE] = metrics->mae,
        [GLINT_FIGURE_P99] = metrics->p99,
        [GLINT_FIGURE_MAX] = metrics->largest,
        [GLINT_FIGURE_PSNR] = metrics->psnr,
        [GLINT_FIGURE_DIFFERING] = compared > 0 ? (double)metrics->differing / compared : 0,
        [GLINT_FIGURE_NAN] = (double)metrics->in_either.nan,
        [GLINT_FIGURE_INFINITE] = (double)metrics->in_either.infinite,
        [GLINT_FIGURE_ALPHA] = metrics->alpha,
    };
    return values[figure];
}

bool glint_bounds_any(const glint_bounds *bounds)
{
    bool any = false;
    for (int i = 0; i < GLINT_FIGURE_COUNT; i++) {
        any = any || bounds->is_set[i];
    }
    return any;
}

void glint_bounds_complete(glint_bounds *bounds)
{
    const bool any = glint_bounds_any(bounds);
    const glint_figure implied[] = {GLINT_FIGURE_NAN, GLINT_FIGURE_INFINITE};
    for (int i = 0; any && i < 2; i++) {
        // The limit is 0 already if it was not set.
        bounds->is_set[implied[i]] = true;
    }
}

bool glint_bound_is_kept(const glint_bounds *bounds, glint_figure figure,
                         const glint_metrics *metrics)
{
    const double value = glint_figure_value(figure, metrics), limit = bounds->limit[figure];
    // NaN fails both comparisons.
    const bool kept = glint_figure_is_better_high(figure) ? value >= limit : value <= limit;
    return kept && metrics->compared > 0;
}

// Writes "rmse 0.0123 is above 0.01", with all digits if six digits are equal.
static void describe(glint_figure figure, double value, double limit, char *text, size_t capacity)
{
    const char *side = glint_figure_is_better_high(figure) ? "below" : "above";
    char is[32], may_be[32];
    snprintf(is, sizeof is, "%.6g", value);
    snprintf(may_be, sizeof may_be, "%.6g", limit);
    if (strcmp(is, may_be) == 0) {
        snprintf(is, sizeof is, "%.17g", value);
        snprintf(may_be, sizeof may_be, "%.17g", limit);
    }
    snprintf(text, capacity, "%s %s is %s %s", glint_figure_names[figure], is, side, may_be);
}

glint_status glint_bounds_check(const glint_bounds *bounds, const glint_metrics *metrics,
                                const char *image, const char *reference, glint_error *error)
{
    char broken[GLINT_FIGURE_COUNT * 96] = "";
    size_t length = 0;
    if (glint_bounds_any(bounds) && metrics->compared == 0) {
        return glint_fail(error, GLINT_MISMATCH,
                          "%s: no pixel is finite in both pictures, so every bound is broken (%s)",
                          image, reference);
    }
    for (int i = 0; i < GLINT_FIGURE_COUNT; i++) {
        const glint_figure figure = (glint_figure)i;
        if (bounds->is_set[i] && !glint_bound_is_kept(bounds, figure, metrics)) {
            char text[96];
            describe(figure, glint_figure_value(figure, metrics), bounds->limit[i], text,
                     sizeof text);
            length += (size_t)snprintf(broken + length, sizeof broken - length, "%s%s",
                                       length > 0 ? ", " : "", text);
        }
    }
    return length == 0 ? GLINT_OK
                       : glint_fail(error, GLINT_MISMATCH, "%s: %s (%s)", image, broken, reference);
}
