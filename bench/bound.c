// bench_bound WIDTHxHEIGHT VIEWS ROUNDS SCENE…: compares the settings that --max-error chooses with
// the fastest settings that keep the bound.
//
// It takes each scene (a file or a built-in scene) in the studio, from VIEWS places of a turntable,
// with the bounds 0.1, 0.01, 0.001 and 0.0001. It renders all candidate settings once. The five
// fastest within the bound run again, in turns with the choice.
//
// Prints one line for each bound, with tabs between: scene, view, bound, options, predicted error,
// error over the whole frame, frames rendered, milliseconds for choosing, milliseconds of the
// frame, the reference's time over the frame's, options of the fastest way, and the frame's time
// over the fastest way's (median and quartiles over ROUNDS).
#include "options.h"

#include "base/statistics.h"
#include "bound/error_bound.h"
#include "glint.h"
#include "image/metrics.h"
#include "scene/built_in.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

enum { ROUNDS_MAX = 32, WAYS_MAX = 80, BOUNDS = 4, FINALISTS = 5 };

static const double bounds[BOUNDS] = {0.1, 0.01, 0.001, 0.0001};

// One way of rendering, with its measured error and time.
typedef struct way {
    glint_rung rung;
    double error, ms;
} way;

typedef struct contest {
    const char *name;
    int view;
    glint_device *device;
    const glint_environment *studio;
    glint_scene scene;
    glint_camera camera;
    glint_settings settings;
    glint_renderer *renderer;
    glint_image reference, image;
    double reference_ms;
    way ways[WAYS_MAX];
    size_t way_count;
    int rounds;
} contest;

static glint_status load(const char *name, contest *c, glint_error *error)
{
    struct stat facts;
    c->name = name;
    TRY(stat(name, &facts) == 0 ? glint_scene_load(name, NULL, &c->scene, NULL, error)
                                : glint_built_in_scene(name, &c->scene, error));
    return glint_scene_camera(&c->scene, NULL, &c->camera, error);
}

static glint_status render(contest *c, const glint_settings *settings, glint_image *image,
                           double *ms, glint_error *error)
{
    glint_frame_report report;
    TRY(glint_renderer_set_settings(c->renderer, settings, error));
    TRY(glint_renderer_frame(&(glint_frame_request){c->renderer, &c->camera, NULL, image, &report},
                             error));
    *ms = report.kernel_ms;
    return GLINT_OK;
}

static double error_of(const contest *c)
{
    glint_metrics metrics;
    glint_error error = {0};
    if (glint_metrics_find(&c->image, &c->reference, NULL, &metrics, &error) != GLINT_OK) {
        glint_error_free(&error);
        return (double)NAN;
    }
    return metrics.relative_rmse;
}

static void reference_of(const contest *c, glint_rung *reference)
{
    const glint_plan *plan = glint_renderer_plan(c->renderer);
    glint_rung_reference(&c->settings, plan->features[GLINT_FEATURE_ROUGH].compiled, reference);
}

// Lists all settings that --max-error chooses from.
static void list_ways(contest *c)
{
    const bool splits = glint_renderer_plan(c->renderer)->features[GLINT_FEATURE_SPLIT].compiled;
    c->way_count = 0;
    for (int step = 4; splits && step < 32; step++) {
        const double weight = exp2(-0.5 * step);
        glint_rung_by_weight(&c->settings, GLINT_PRECISION_FLOAT, GLINT_TEXELS_AUTO, weight,
                             &c->ways[c->way_count++].rung);
        glint_rung_by_weight(&c->settings, GLINT_PRECISION_DOUBLE, GLINT_TEXELS_AUTO, weight,
                             &c->ways[c->way_count++].rung);
    }
    for (int depth = 0; !splits && depth <= 8; depth = depth == 0 ? 1 : 2 * depth) {
        glint_rung_by_depth(&c->settings, depth, &c->ways[c->way_count++].rung);
    }
    for (int i = 0; !splits && i < 2; i++) {
        glint_rung_by_weight(&c->settings, i == 0 ? GLINT_PRECISION_FLOAT : GLINT_PRECISION_DOUBLE,
                             GLINT_TEXELS_FLOAT, glint_settings_default.min_weight,
                             &c->ways[c->way_count++].rung);
    }
}

static glint_status try_ways(contest *c, glint_error *error)
{
    glint_rung reference;
    reference_of(c, &reference);
    TRY(render(c, &reference.settings, &c->reference, &c->reference_ms, error));
    list_ways(c);
    for (size_t i = 0; i < c->way_count; i++) {
        TRY(render(c, &c->ways[i].rung.settings, &c->image, &c->ways[i].ms, error));
        c->ways[i].error = error_of(c);
    }
    return GLINT_OK;
}

// Finds the fastest ways within the bound, by one frame each. Without any, returns the reference.
static size_t best_within(const contest *c, double bound, way best[FINALISTS])
{
    size_t count = 0;
    for (size_t i = 0; i < c->way_count; i++) {
        if (!(c->ways[i].error <= bound)) {
            continue;
        }
        size_t at = count < FINALISTS ? count++ : FINALISTS;
        for (; at > 0 && best[at - 1].ms > c->ways[i].ms; at--) {
            if (at < FINALISTS) {
                best[at] = best[at - 1];
            }
        }
        if (at < FINALISTS) {
            best[at] = c->ways[i];
        }
    }
    if (count == 0) {
        reference_of(c, &best[count++].rung);
    }
    return count;
}

typedef struct verdict {
    const glint_rung *fastest;
    glint_summary ratio; // the choice's time over the fastest way's
    double ms;           // the choice's median
} verdict;

typedef struct finalists {
    way ways[FINALISTS];
    size_t count;
} finalists;

// Times the choice and the finalists in turns.
static glint_status compare(contest *c, const glint_settings *chosen, const finalists *best,
                            verdict *v, glint_error *error)
{
    const size_t count = best->count;
    double times[FINALISTS + 1][ROUNDS_MAX], ratios[ROUNDS_MAX];
    const size_t rounds = (size_t)c->rounds;
    for (size_t i = 0; i < rounds; i++) {
        for (size_t k = 0; k <= count; k++) {
            const glint_settings *settings = k == count ? chosen : &best->ways[k].rung.settings;
            TRY(render(c, settings, &c->image, &times[k][i], error));
        }
    }
    size_t fastest = 0;
    double least = (double)INFINITY;
    for (size_t k = 0; k < count; k++) {
        const double median = glint_summarize(times[k], rounds).median;
        fastest = median < least ? k : fastest;
        least = fmin(least, median);
    }
    for (size_t i = 0; i < rounds; i++) {
        ratios[i] = times[count][i] / times[fastest][i];
    }
    *v = (verdict){&best->ways[fastest].rung, glint_summarize(ratios, rounds),
                   glint_summarize(times[count], rounds).median};
    return GLINT_OK;
}

static glint_status judge(contest *c, double bound, glint_error *error)
{
    glint_error_bound asked;
    glint_error_choice choice;
    glint_frame_report report;
    glint_error_bound_begin(&asked, bound, &c->settings);
    glint_error_bound_set_environment(&asked, &c->studio->radiance);
    const glint_frame_request request = {c->renderer, &c->camera, NULL, &c->image, &report};
    TRY(glint_error_bound_frame(&asked, &request, &choice, error));
    const double is = error_of(c);
    verdict v;
    finalists best;
    best.count = best_within(c, bound, best.ways);
    TRY(compare(c, &choice.rung.settings, &best, &v, error));
    printf("%s\t%d\t%g\t%s\t%.2g\t%.2g\t%s\t%d\t%.0f\t%.1f\t%.2f\t%s\t%.2f\t%.2f\t%.2f\n", c->name,
           c->view, bound, choice.rung.options, choice.error, is, is <= bound ? "kept" : "MISSED",
           choice.frames, choice.choosing_ms, v.ms, c->reference_ms / v.ms, v.fastest->options,
           v.ratio.median, v.ratio.lower_quartile, v.ratio.upper_quartile);
    fflush(stdout);
    return GLINT_OK;
}

static glint_status run_view(contest *c, int view, int views, glint_error *error)
{
    const glint_camera first = c->camera;
    const glint_vec3 low = c->scene.low, high = c->scene.high;
    const glint_vec3 middle = glint_vec3_scale(glint_vec3_add(low, high), 0.5);
    c->view = view;
    c->camera = glint_camera_orbit(&first, middle, view - 1, views);
    glint_status status;
    TRY_OR(cleanup, status, try_ways(c, error));
    for (int i = 0; i < BOUNDS; i++) {
        TRY_OR(cleanup, status, judge(c, bounds[i], error));
    }
cleanup:
    c->camera = first;
    return status;
}

static glint_status run_scene(const char *name, contest *c, int views, glint_error *error)
{
    glint_status status;
    TRY_OR(cleanup, status, load(name, c, error));
    const glint_renderer_inputs inputs = {.device = c->device,
                                          .scene = &c->scene,
                                          .environment = c->studio,
                                          .settings = &c->settings};
    TRY_OR(cleanup, status, glint_renderer_create(&inputs, &c->renderer, error));
    for (int view = 1; view <= views; view++) {
        TRY_OR(cleanup, status, run_view(c, view, views, error));
    }
cleanup:
    glint_renderer_free(c->renderer);
    c->renderer = NULL;
    glint_scene_free(&c->scene);
    return status;
}

static glint_status run(char **arguments, int count, contest *c, glint_environment *studio,
                        glint_error *error)
{
    double views = 1, rounds = 1;
    if (count < 4) {
        return glint_fail(error, GLINT_USAGE, "WIDTHxHEIGHT VIEWS ROUNDS SCENE… are expected");
    }
    TRY(bench_parse_size(arguments[0], &c->settings.width, &c->settings.height, error));
    TRY(bench_parse_count("views", arguments[1], 1000, &views, error));
    TRY(bench_parse_count("rounds", arguments[2], ROUNDS_MAX, &rounds, error));
    TRY(glint_environment_studio(studio, error));
    TRY(glint_device_open(NULL, &c->device, error));
    c->studio = studio;
    c->rounds = (int)rounds;
    for (int i = 3; i < count; i++) {
        TRY(run_scene(arguments[i], c, (int)views, error));
    }
    return GLINT_OK;
}

int main(int argc, char **argv)
{
    glint_error error = {0};
    glint_environment studio = {0};
    static contest c;
    c.settings = glint_settings_default;
    const glint_status status = run(argv + 1, argc - 1, &c, &studio, &error);
    glint_image_free(&c.image);
    glint_image_free(&c.reference);
    glint_device_close(c.device);
    glint_environment_free(&studio);
    return bench_finish("bench_bound", status, &error);
}
