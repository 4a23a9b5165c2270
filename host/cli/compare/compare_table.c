// Prints the result of glint compare as a table. See compare_table.h.
#include "cli/compare/compare_table.h"

#include <math.h>

static void explain_max(const glint_metrics *metrics, FILE *out)
{
    const float *image = metrics->worst_image, *reference = metrics->worst_reference;
    fprintf(out, "largest difference");
    if (metrics->largest > 0) {
        fprintf(out, ", at %d,%d: %.4g %.4g %.4g, reference %.4g %.4g %.4g", metrics->worst_x,
                metrics->worst_y, (double)image[0], (double)image[1], (double)image[2],
                (double)reference[0], (double)reference[1], (double)reference[2]);
    }
}

static void explain_defects(uint64_t in_image, uint64_t in_reference, const char *what, FILE *out)
{
    fprintf(out, "pixels with %s: %llu in the image, %llu in the reference", what,
            (unsigned long long)in_image, (unsigned long long)in_reference);
}

static void explain_alpha(const glint_compare_result *result, FILE *out)
{
    const bool image = glint_image_has_alpha(result->image.image);
    const bool reference = glint_image_has_alpha(result->reference.image);
    fprintf(out, "largest difference of alpha");
    if (!image && !reference) {
        fprintf(out, ": neither has any");
    } else if (image != reference) {
        fprintf(out, ", where %s has none: 1 is taken",
                image ? result->reference.name : result->image.name);
    }
}

static void explain(const glint_compare_result *result, glint_figure figure, FILE *out)
{
    const glint_metrics *metrics = result->metrics;
    switch (figure) {
    case GLINT_FIGURE_RMSE:
        fprintf(out, "root of the mean square difference");
        break;
    case GLINT_FIGURE_RELATIVE_RMSE:
        fprintf(out, "rmse over the reference's mean, %.4g", metrics->mean);
        break;
    case GLINT_FIGURE_MAE:
        fprintf(out, "mean absolute difference");
        break;
    case GLINT_FIGURE_P99:
        fprintf(out, "99%% of the pixels are off by no more");
        break;
    case GLINT_FIGURE_MAX:
        explain_max(metrics, out);
        break;
    case GLINT_FIGURE_PSNR:
        fprintf(out, metrics->rmse > 0 ? "dB below a peak of %g" : "dB: R, G and B are identical",
                GLINT_METRICS_PEAK);
        break;
    case GLINT_FIGURE_DIFFERING:
        fprintf(out, "share of the pixels that are off by more than %g%%: %llu",
                100 * GLINT_METRICS_VISIBLE, (unsigned long long)metrics->differing);
        break;
    case GLINT_FIGURE_NAN:
        explain_defects(metrics->in_image.nan, metrics->in_reference.nan, "a NaN", out);
        break;
    case GLINT_FIGURE_INFINITE:
        explain_defects(metrics->in_image.infinite, metrics->in_reference.infinite, "an infinity",
                        out);
        break;
    case GLINT_FIGURE_ALPHA:
        explain_alpha(result, out);
        break;
    case GLINT_FIGURE_COUNT:
        break;
    }
}

void glint_compare_print(const glint_compare_result *result, FILE *out)
{
    const glint_metrics *metrics = result->metrics;
    fprintf(out, "%s against %s\n%dx%d pixels, %llu compared, in linear light\n\n",
            result->image.name, result->reference.name, result->reference.image->width,
            result->reference.image->height, (unsigned long long)metrics->compared);
    for (int i = 0; i < GLINT_FIGURE_COUNT; i++) {
        const glint_figure figure = (glint_figure)i;
        const bool counts_all = figure == GLINT_FIGURE_NAN || figure == GLINT_FIGURE_INFINITE;
        fprintf(out, "  %-14s ", glint_figure_names[i]);
        if (metrics->compared > 0 || counts_all) {
            fprintf(out, "%-12.6g ", glint_figure_value(figure, metrics));
            explain(result, figure, out);
            fprintf(out, "\n");
        } else {
            fprintf(out, "-\n"); // no pixels were compared
        }
    }
}
