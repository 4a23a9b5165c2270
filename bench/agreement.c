// Compares the frames of two programs. See agreement.h.
#include "agreement.h"

#include <math.h>

static double relative_rmse(double sum_of_squares, double sum, double count)
{
    return sqrt(sum_of_squares / count) / (sum / count);
}

bench_agreement bench_compare_colors(const glint_image *glint, const float *other)
{
    bench_agreement found = {.pixels = (uint64_t)glint->width * (uint64_t)glint->height};
    double squares = 0, sum = 0;
    for (size_t i = 0; i < found.pixels; i++) {
        bool same = true;
        for (size_t c = 0; c < 3; c++) {
            double a = (double)glint->pixels[4 * i + c], b = (double)other[4 * i + c];
            squares += (a - b) * (a - b);
            sum += a;
            // NaN on either side is a difference.
            same = same && fabs(a - b) <= BENCH_DIFFERENT * fmax(fabs(a), fabs(b));
        }
        found.different_pixels += !same;
    }
    found.relative_rmse = relative_rmse(squares, sum, 3 * (double)found.pixels);
    return found;
}

// Depth of the hit point along the camera's axis, in stored units.
static double hit_depth(const bench_scene *scene, const float *hit)
{
    const glint_scene *soup = &scene->scene;
    const glint_camera *camera = &scene->camera;
    const float *v = soup->positions + 9 * (size_t)hit[3];
    const double b1 = (double)hit[1], b2 = (double)hit[2];
    double p[3];
    for (size_t k = 0; k < 3; k++) {
        p[k] = (1 - b1 - b2) * (double)v[k] + b1 * (double)v[3 + k] + b2 * (double)v[6 + k];
    }
    glint_vec3 eye =
        glint_vec3_scale(glint_vec3_subtract(camera->eye, soup->origin), 1 / soup->unit);
    glint_vec3 from_eye = glint_vec3_subtract((glint_vec3){p[0], p[1], p[2]}, eye);
    return -glint_vec3_dot(from_eye, camera->back);
}

bench_agreement bench_compare_hits(const bench_scene *scene, const glint_image *glint,
                                   const embree_hit *embree)
{
    bench_agreement found = {.pixels = (uint64_t)glint->width * (uint64_t)glint->height};
    double squares = 0, sum = 0, count = 0;
    for (size_t i = 0; i < found.pixels; i++) {
        const float *hit = glint->pixels + 4 * i;
        bool glint_met = hit[3] >= 0, embree_met = embree[i].triangle != UINT32_MAX;
        if (!glint_met || !embree_met) {
            found.different_pixels += glint_met != embree_met;
            continue;
        }
        double a = hit_depth(scene, hit), b = (double)embree[i].t;
        squares += (a - b) * (a - b);
        sum += a;
        count++;
        found.different_pixels += !(fabs(a - b) <= BENCH_DIFFERENT * fmax(a, b));
    }
    found.relative_rmse = count > 0 ? relative_rmse(squares, sum, count) : 0;
    return found;
}

bench_agreement bench_agreement_worse(bench_agreement a, bench_agreement b)
{
    bench_agreement worse = a.different_pixels > b.different_pixels ? a : b;
    worse.relative_rmse = fmax(a.relative_rmse, b.relative_rmse);
    return worse;
}

glint_status bench_check_agreement(const bench_agreement *agreement, const char *scene,
                                   const char *job, glint_error *error)
{
    double share = (double)agreement->different_pixels / (double)agreement->pixels;
    // Refuses NaN, too.
    if (share <= BENCH_DIFFERENT_SHARE_MAX && agreement->relative_rmse <= BENCH_RELATIVE_RMSE_MAX) {
        return GLINT_OK;
    }
    return glint_fail(error, GLINT_MISMATCH,
                      "%s, %s: the frames differ (relative RMSE %.3g; %llu of %llu pixels by more "
                      "than %g)",
                      scene, job, agreement->relative_rmse,
                      (unsigned long long)agreement->different_pixels,
                      (unsigned long long)agreement->pixels, BENCH_DIFFERENT);
}
