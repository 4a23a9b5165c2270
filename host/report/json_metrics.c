// The error figures of a picture as JSON. See json.h.
#include "report/json.h"

#include <math.h>

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
