// Compares a frame with the oracle. See judged.h.
#include "selftest/judged.h"

#include <math.h>

glint_status judged_frame(trial *t, const glint_scene *scene, const glint_camera *camera,
                          const glint_settings *settings, judged *out)
{
    glint_environment environment = {0};
    *out = (judged){.proxy = out->proxy};
    glint_status status;
    TRY_OR(cleanup, status, trial_linear_environment(JUDGED_EDGE, &environment, t->error));
    if (out->proxy != NULL) {
        environment.proxy = *out->proxy;
    }
    const glint_renderer_inputs inputs = trial_inputs(t, scene, &environment, settings);
    TRY_OR(cleanup, status, trial_frame(t, &inputs, camera, &out->picture));
    TRY_OR(cleanup, status, judge_begin(scene, &out->judge, t->error));
    judge_use_linear_light(&out->judge);
    out->view = judge_view(camera, settings);
    out->view.depth = settings->depth;
    out->view.min_weight = settings->min_weight;
    out->view.transparent = settings->transparent;
    out->judge.scene.environment_rotation = settings->env_rotate;
cleanup:
    glint_environment_free(&environment);
    return status;
}

void judged_pixel(const judged *of, int p, double expected[4], oracle_report *report)
{
    const int pixel[2] = {p % of->picture.width, p / of->picture.width};
    oracle_pixel(&of->judge.scene, &of->view, pixel, expected, report);
}

// False for pixels where rounding may decide otherwise. They are left out.
static bool is_decided(const oracle_report *report)
{
    return report->edge >= 1e-6 && report->critical > 1e-4 && report->threshold > 1e-4 &&
           report->jump > 1e-4;
}

void judged_compare(const judged *of, glint_measure *errors)
{
    const int width = of->picture.width;
    for (int p = 0; p < width * of->picture.height; p++) {
        double expected[4];
        oracle_report report;
        judged_pixel(of, p, expected, &report);
        for (int k = 0; is_decided(&report) && k < 4; k++) {
            measure_value(errors, of->picture.values[4 * p + k], expected[k], 1,
                          "pixel (%d, %d), value %d", p % width, p / width, k);
        }
    }
}

double judged_spread(const judged *of, int p, double start, const double expected[4])
{
    judged moved = *of;
    double spread = 0;
    for (int side = -1; side <= 1; side += 2) {
        double color[4];
        moved.view.start = side * start;
        judged_pixel(&moved, p, color, NULL);
        for (int k = 0; k < 4; k++) {
            spread = fmax(spread, fabs(color[k] - expected[k]));
        }
    }
    return spread;
}

double judged_rmse(const judged *of)
{
    const int pixels = of->picture.width * of->picture.height;
    double squares = 0, light = 0;
    for (int p = 0; p < pixels; p++) {
        double expected[4];
        oracle_report report;
        judged_pixel(of, p, expected, &report);
        for (int k = 0; k < 3; k++) {
            const double off = of->picture.values[4 * p + k] - expected[k];
            squares += off * off;
            light += expected[k];
        }
    }
    return sqrt(3.0 * pixels * squares) / light;
}

void judged_end(judged *of)
{
    judge_end(&of->judge);
    trial_picture_free(&of->picture);
}
