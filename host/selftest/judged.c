// Compares a frame with the oracle. See judged.h.
#include "selftest/judged.h"

#include <math.h>
#include <string.h>

static oracle_proxy proxy_of(const glint_proxy *p)
{
    return (oracle_proxy){.sphere = p->kind == GLINT_PROXY_SPHERE,
                          .center = {p->center.x, p->center.y, p->center.z},
                          .middle = {p->middle.x, p->middle.y, p->middle.z},
                          .half = {p->half_extent.x, p->half_extent.y, p->half_extent.z}};
}

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
    if (out->proxy != NULL) {
        out->seen_proxy = proxy_of(out->proxy);
        out->judge.scene.proxy = &out->seen_proxy;
    }
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

// Measures the errors of all decided values, or the share of values off by more than `bound`; the
// other measure is NULL.
static void compare_values(const judged *of, glint_measure *errors, double bound,
                           glint_measure *share)
{
    const int width = of->picture.width;
    for (int p = 0; p < width * of->picture.height; p++) {
        double expected[4];
        oracle_report report;
        judged_pixel(of, p, expected, &report);
        for (int k = 0; is_decided(&report) && k < 4; k++) {
            const double got = of->picture.values[4 * p + k];
            if (errors != NULL) {
                measure_value(errors, got, expected[k], 1, "pixel (%d, %d), value %d", p % width,
                              p / width, k);
            } else {
                measure_event(share, !(fabs(got - expected[k]) <= bound),
                              "pixel (%d, %d), value %d: expected %.9g, got %.9g", p % width,
                              p / width, k, expected[k], got);
            }
        }
    }
}

void judged_compare(const judged *of, glint_measure *errors)
{
    compare_values(of, errors, 0, NULL);
}

void judged_count(const judged *of, double bound, glint_measure *share)
{
    compare_values(of, NULL, bound, share);
}

// Layout of the stored terms: see terms.h.
enum { OF_PIXEL = 4, OF_TERM = 7 };

// Sums a pixel's terms under E(d) = ½ + ½d, whose irradiance over π is ½ + ⅓n. E is turned about
// +Y. `channels` are those of the terms.
static void sum_terms(const glint_channel *channels, size_t count, double degrees, int p,
                      double sum[3])
{
    const double c = cos(degrees * GLINT_PI / 180), s = sin(degrees * GLINT_PI / 180);
    for (int k = 0; k < 3; k++) {
        sum[k] = (double)channels[k].values[p];
    }
    for (size_t i = OF_PIXEL; i + OF_TERM <= count; i += OF_TERM) {
        const glint_channel *term = &channels[i];
        const double x = (double)term[0].values[p], z = (double)term[2].values[p];
        const double turned[3] = {c * x - s * z, (double)term[1].values[p], c * z + s * x};
        for (int k = 0; k < 3; k++) {
            const double light = term[3].values[p] == 0 ? 0.5 + turned[k] / 2 : 0.5 + turned[k] / 3;
            sum[k] += (double)term[4 + k].values[p] * light;
        }
    }
}

void judged_compare_terms(const judged *of, glint_measure *errors)
{
    const glint_layers *layers = &of->picture.layers;
    size_t first = 0, end = 0; // the terms' channels
    for (size_t i = layers->count; i-- > 0;) {
        if (strncmp(layers->channels[i].name, "terms.", 6) == 0) {
            first = i;
            end = end > 0 ? end : i + 1;
        }
    }
    const glint_channel *channels = layers->channels + first;
    for (int p = 0; p < of->picture.width * of->picture.height; p++) {
        double sum[3];
        sum_terms(channels, end - first, of->judge.scene.environment_rotation, p, sum);
        const bool is_whole = channels[3].values[p] == 0; // no term was dropped
        for (int k = 0; is_whole && k < 3; k++) {
            measure_value(errors, sum[k], of->picture.values[4 * p + k], 1, "pixel %d, value %d", p,
                          k);
        }
    }
}

void judged_compare_hits(const judged *of, glint_measure *errors)
{
    for (int p = 0; p < of->picture.width * of->picture.height; p++) {
        const int column = p % of->picture.width, row = p / of->picture.width;
        const double at[2] = {column + 0.5, row + 0.5};
        const double *found = of->picture.values + 4 * p;
        double rgba[4];
        oracle_report report;
        judged_pixel(of, p, rgba, &report);
        const oracle_ray ray = oracle_primary_ray(&of->view, at);
        const oracle_hit hit = oracle_closest_hit(&of->judge.scene, &ray, -1);
        if (report.edge >= 1e-6) {
            measure_value(errors, found[3], hit.triangle, 1, "pixel %d: the triangle", p);
        }
        for (int k = 1; report.edge >= 1e-6 && hit.triangle >= 0 && k < 3; k++) {
            measure_value(errors, found[k], hit.barycentric[k], 1, "pixel %d: weight %d", p, k);
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
