// Error figures by name, and bounds on them. See figures.h.
#include "report/figures.h"

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
    switch (figure) {
    case GLINT_FIGURE_RMSE:
        return metrics->rmse;
    case GLINT_FIGURE_RELATIVE_RMSE:
        return metrics->relative_rmse;
    case GLINT_FIGURE_MAE:
        return metrics->mae;
    case GLINT_FIGURE_P99:
        return metrics->p99;
    case GLINT_FIGURE_MAX:
        return metrics->largest;
    case GLINT_FIGURE_PSNR:
        return metrics->psnr;
    case GLINT_FIGURE_DIFFERING:
        return metrics->compared > 0 ? (double)metrics->differing / (double)metrics->compared : 0;
    case GLINT_FIGURE_NAN:
        return (double)metrics->in_either.nan;
    case GLINT_FIGURE_INFINITE:
        return (double)metrics->in_either.infinite;
    case GLINT_FIGURE_ALPHA:
        return metrics->alpha;
    case GLINT_FIGURE_COUNT:
        break;
    }
    return 0;
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
        // A limit that is not set is 0 already.
        bounds->is_set[implied[i]] = true;
    }
}

bool glint_bound_is_kept(const glint_bounds *bounds, glint_figure figure,
                         const glint_metrics *metrics)
{
    const double value = glint_figure_value(figure, metrics), limit = bounds->limit[figure];
    // Comparisons that NaN fails.
    const bool kept = glint_figure_is_better_high(figure) ? value >= limit : value <= limit;
    return kept && metrics->compared > 0;
}

// "rmse 0.0123 is above 0.01", with all digits where six do not tell the two apart.
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
