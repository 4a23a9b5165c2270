// Writes figures as JSON: the summary of measurements, and the errors of a picture. See json.h.
#include "report/json.h"

#include <math.h>

json_t *glint_json_summary(const glint_summary *summary)
{
    json_t *object = json_object();
    glint_json_put_count(object, "count", summary->count);
    glint_json_put_real(object, "median", summary->median);
    glint_json_put_real(object, "lower_quartile", summary->lower_quartile);
    glint_json_put_real(object, "upper_quartile", summary->upper_quartile);
    glint_json_put_real(object, "minimum", summary->minimum);
    glint_json_put_real(object, "maximum", summary->maximum);
    glint_json_put_real(object, "median_absolute_deviation", summary->deviation);
    return object;
}

json_t *glint_json_metrics(const glint_metrics *metrics)
{
    const struct {
        const char *name;
        double value;
    } figures[] = {
        {"relative_rmse", metrics->relative_rmse},
        {"rmse", metrics->rmse},
        {"mae", metrics->mae},
        {"psnr", metrics->psnr},
        {"p99", metrics->p99},
        {"largest", metrics->largest},
        {"reference_mean", metrics->mean},
    };
    json_t *object = json_object();
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++) {
        glint_json_put_real(object, figures[i].name,
                            metrics->compared > 0 ? figures[i].value : NAN);
    }
    glint_json_put_count(object, "compared_pixels", metrics->compared);
    glint_json_put_count(object, "differing_pixels", metrics->differing);
    glint_json_put_count(object, "nonfinite_pixels", metrics->nonfinite);
    return object;
}
