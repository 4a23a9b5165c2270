// Measures speed against error. See speed_error.h.
//
// The steps, in this order:
//   1. the reference
//   2. each rung's first frame and its errors
//   3. the errors of each rung's directions, with separate kernels that keep the directions
//   4. the timed frames, one of every rung in turn: a machine that slows down slows all rungs
//   5. the error of sampling
#include "report/speed_error/speed_error.h"

#include "base/clock.h"
#include "render/view.h"
#include "report/compare/heat_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REFERENCE GLINT_RUNGS_MAX // index of the reference among the renderers
#define RENDERERS (GLINT_RUNGS_MAX + 1)
#define TRUTH_SAMPLES 8 // factor of samples on each axis
#define LEAST_ROUNDS 5

typedef struct times {
    double *values;
    size_t count, capacity;
} times;

// The state of a measurement. Zero is valid.
typedef struct run {
    const glint_bench_inputs *inputs;
    const glint_speed_error_options *options;
    glint_bench_watcher watcher;
    glint_speed_error_result *result;
    glint_device *device;
    glint_ladder ladder;
    glint_renderer *shared;         // for all settings that are variations of the scene's settings
    glint_renderer *own[RENDERERS]; // for other settings; NULL until needed
    times times[RENDERERS];
    glint_image reference, again;
    glint_layers reference_layers;
} run;

static void show(const run *r, const char *doing, const char *what)
{
    char text[160];
    if (r->watcher.show != NULL) {
        snprintf(text, sizeof text, "%s%s", doing, what);
        r->watcher.show(r->watcher.context, text);
    }
}

static glint_status create(run *r, const glint_settings *settings, glint_renderer **renderer,
                           glint_error *error)
{
    const glint_renderer_inputs inputs = {
        .device = r->device,
        .scene = r->inputs->scene,
        .environment = r->inputs->environment,
        .settings = settings,
        .kernel_dir = r->inputs->kernel_dir,
    };
    return glint_renderer_create(&inputs, renderer, error);
}

static glint_status render(run *r, glint_renderer *renderer, glint_image *image,
                           glint_frame_report *report, glint_error *error)
{
    const glint_progress progress = glint_bench_progress(&r->watcher);
    return glint_renderer_frame(
        &(glint_frame_request){renderer, r->inputs->camera, &progress, image, report}, error);
}

// Finds the renderer for these settings. Variations use the shared renderer; for other settings,
// *own is created if it is NULL.
static glint_status provide(run *r, const glint_settings *settings, glint_renderer **own,
                            glint_renderer **renderer, glint_error *error)
{
    if (glint_settings_are_variation(settings, r->inputs->settings)) {
        *renderer = r->shared;
        return glint_renderer_set_settings(r->shared, settings, error);
    }
    glint_status status = *own == NULL ? create(r, settings, own, error) : GLINT_OK;
    *renderer = *own;
    return status;
}

static glint_status open_device(run *r, glint_error *error)
{
    glint_status status = glint_device_open(r->inputs->device, &r->device, error);
    if (status != GLINT_OK) {
        return status;
    }
    r->result->device = *glint_device_capabilities(r->device);
    if (!r->result->device.has_double) {
        return glint_fail(
            error, GLINT_DEVICE_LACKS,
            "device '%s' has no double precision, which errors are counted from (name "
            "another with --device)",
            r->result->device.name);
    }
    return GLINT_OK;
}

static glint_status make_ladder(run *r, glint_error *error)
{
    TRY(create(r, r->inputs->settings, &r->shared, error));
    glint_plan plan = *glint_renderer_plan(r->shared);
    const glint_stored_space space = glint_stored_space_of(r->inputs->scene);
    glint_plan_suit(&plan, &space, r->inputs->camera);
    glint_ladder_make(&plan, r->inputs->settings, &r->ladder);
    r->result->bvh = *glint_renderer_bvh(r->shared);
    r->result->count = r->ladder.count;
    r->result->reference = r->ladder.reference;
    return GLINT_OK;
}

// ---- The reference -----------------------------------------------------------------------------

// Measures how much the reference changes with another depth or other weights.
static glint_status find_change(run *r, int times_depth, double times_weight, glint_metrics *change,
                                glint_error *error)
{
    glint_settings settings = r->ladder.reference.settings;
    settings.depth *= times_depth;
    settings.min_weight *= times_weight;
    glint_renderer *own = NULL, *renderer;
    glint_image image = {0};
    glint_status status;
    TRY_OR(cleanup, status, provide(r, &settings, &own, &renderer, error));
    TRY_OR(cleanup, status, render(r, renderer, &image, NULL, error));
    TRY_OR(cleanup, status, glint_metrics_find(&image, &r->reference, NULL, change, error));
cleanup:
    glint_image_free(&image);
    glint_renderer_free(own);
    return status;
}

static glint_status render_reference(run *r, glint_error *error)
{
    glint_speed_error_result *result = r->result;
    glint_renderer *renderer;
    glint_frame_report report;
    show(r, "rendering ", r->ladder.reference.name);
    TRY(provide(r, &r->ladder.reference.settings, &r->own[REFERENCE], &renderer, error));
    TRY(render(r, renderer, &r->reference, &report, error));
    result->reference_plan = *glint_renderer_plan(renderer);
    result->reference_truncation = report.truncation;
    show(r, "how good is ", r->ladder.reference.name);
    TRY(find_change(r, 1, 4, &result->change_by_weights, error));
    return find_change(r, 2, 1, &result->change_by_depth, error);
}

// ---- Errors ------------------------------------------------------------------------------------

// The part of the phases that belongs to these settings: earlier rungs may have compiled kernels in
// the shared renderer.
static glint_phases phases_since(const run *r, const glint_phases *before,
                                 const glint_renderer *renderer)
{
    glint_phases phases = *glint_renderer_phases(renderer);
    if (renderer == r->shared) {
        phases.kernel_build -= before->kernel_build;
        phases.irradiance -= before->irradiance;
        phases.cells -= before->cells;
        phases.upload -= before->upload;
    }
    return phases;
}

// Renders a rung's first frame and measures its error.
static glint_status judge_rung(run *r, size_t which, glint_error *error)
{
    glint_rung_result *rung = &r->result->rungs[which];
    const glint_phases before = *glint_renderer_phases(r->shared);
    glint_renderer *renderer;
    glint_image image = {0};
    glint_frame_report report;
    rung->rung = r->ladder.rungs[which];
    rung->dominated_by = -1;
    show(r, "rendering ", rung->rung.name);
    glint_status status;
    TRY_OR(cleanup, status, provide(r, &rung->rung.settings, &r->own[which], &renderer, error));
    TRY_OR(cleanup, status, render(r, renderer, &image, &report, error));
    rung->plan = *glint_renderer_plan(renderer);
    rung->phases = phases_since(r, &before, renderer);
    rung->rays = report.rays;
    rung->truncation = report.truncation;
    TRY_OR(cleanup, status, glint_metrics_find(&image, &r->reference, NULL, &rung->error, error));
    if (r->options->pictures) {
        TRY_OR(
            cleanup, status,
            glint_heat_map_paint(&image, &r->reference, GLINT_HEAT_RELATIVE, &rung->heat, error));
        rung->picture = image;
        image = (glint_image){0};
    }
cleanup:
    glint_image_free(&image);
    return status;
}

// Renders the heaviest direction of each pixel, and the triangle that the pixel shows.
static glint_status render_directions(run *r, const glint_settings *settings, glint_layers *layers,
                                      glint_error *error)
{
    glint_settings with = *settings;
    with.terms = 1;
    with.aovs = GLINT_AOV_BIT(GLINT_AOV_TRIANGLE);
    *layers = (glint_layers){0};
    glint_renderer *own = NULL, *renderer;
    glint_status status;
    TRY_OR(cleanup, status, provide(r, &with, &own, &renderer, error));
    TRY_OR(cleanup, status, render(r, renderer, &r->again, NULL, error));
    TRY_OR(cleanup, status, glint_renderer_layers(renderer, layers, error));
cleanup:
    glint_renderer_free(own);
    return status;
}

static size_t pixel_count(const run *r)
{
    int size[2];
    glint_settings_pixels(r->inputs->settings, size);
    return (size_t)size[0] * (size_t)size[1];
}

static uint64_t count_wrong_hits(const run *r, const glint_layers *layers)
{
    // The only layer; it comes before the terms
    const float *triangles = layers->channels[0].values;
    const float *right = r->reference_layers.channels[0].values;
    uint64_t wrong = 0;
    for (size_t i = 0; i < pixel_count(r); i++) {
        wrong += triangles[i] != right[i];
    }
    return wrong;
}

static glint_status judge_directions(run *r, size_t which, glint_error *error)
{
    glint_rung_result *rung = &r->result->rungs[which];
    glint_layers layers;
    if (rung->rung.settings.shading != GLINT_SHADING_PIXEL) {
        return GLINT_OK;
    }
    show(r, "directions of ", rung->rung.name);
    glint_status status;
    TRY_OR(cleanup, status, render_directions(r, &rung->rung.settings, &layers, error));
    rung->wrong_hits = count_wrong_hits(r, &layers);
    rung->has_directions = true;
    TRY_OR(cleanup, status,
           glint_direction_error_find(&layers, &r->reference_layers, pixel_count(r),
                                      &rung->directions, error));
cleanup:
    glint_layers_free(&layers);
    return status;
}

static glint_status judge(run *r, glint_error *error)
{
    for (size_t i = 0; i < r->ladder.count; i++) {
        TRY(judge_rung(r, i, error));
    }
    show(r, "directions of ", r->ladder.reference.name);
    TRY(render_directions(r, &r->ladder.reference.settings, &r->reference_layers, error));
    for (size_t i = 0; i < r->ladder.count; i++) {
        TRY(judge_directions(r, i, error));
    }
    return GLINT_OK;
}

// ---- Times -------------------------------------------------------------------------------------

static glint_status keep_time(times *t, double ms, glint_error *error)
{
    if (t->count == t->capacity) {
        const size_t capacity = t->capacity > 0 ? 2 * t->capacity : 64;
        double *grown = realloc(t->values, capacity * sizeof *grown);
        if (grown == NULL) {
            return glint_fail_memory(error, "measured times");
        }
        t->values = grown;
        t->capacity = capacity;
    }
    t->values[t->count++] = ms;
    return GLINT_OK;
}

// Times one frame of a rung or of the reference.
static glint_status time_frame(run *r, size_t which, glint_error *error)
{
    const glint_rung *rung = which == REFERENCE ? &r->ladder.reference : &r->ladder.rungs[which];
    glint_renderer *renderer;
    glint_frame_report report;
    TRY(provide(r, &rung->settings, &r->own[which], &renderer, error));
    TRY(render(r, renderer, &r->again, &report, error));
    return keep_time(&r->times[which], report.kernel_ms, error);
}

// True if another round is needed after `done` rounds, which took `measured` milliseconds in all.
static bool wants_more(const run *r, size_t done, size_t renderers, double measured)
{
    const glint_speed_error_options *options = r->options;
    return options->rounds > 0
               ? done < (size_t)options->rounds
               : done < LEAST_ROUNDS || measured < 1e3 * options->seconds * (double)renderers;
}

static glint_status time_rungs(run *r, glint_error *error)
{
    glint_status status = GLINT_OK;
    const double begun = glint_now_ms();
    char round[32];
    for (size_t done = 0; wants_more(r, done, r->ladder.count + 1, glint_now_ms() - begun);
         done++) {
        snprintf(round, sizeof round, "%zu", done + 1);
        show(r, "measuring, round ", round);
        for (size_t i = 0; i < r->ladder.count; i++) {
            TRY_OR(cleanup, status, time_frame(r, i, error));
        }
        TRY_OR(cleanup, status, time_frame(r, REFERENCE, error));
    }
cleanup:
    for (size_t i = 0; i < r->ladder.count; i++) {
        r->result->rungs[i].kernel = glint_summarize(r->times[i].values, r->times[i].count);
    }
    const times *of = &r->times[REFERENCE];
    r->result->reference_kernel = glint_summarize(of->values, of->count);
    return status;
}

// The error of the whole picture: NaN if any pixel is not finite, because the RMSE leaves such
// pixels out.
static double error_of(const glint_rung_result *rung)
{
    return rung->error.nonfinite > 0 ? (double)NAN : rung->error.relative_rmse;
}

static bool dominates(const glint_rung_result *a, const glint_rung_result *b)
{
    const double ea = error_of(a), eb = error_of(b);
    const double ta = a->kernel.median, tb = b->kernel.median;
    if (isnan(eb) || isnan(ea)) {
        return isnan(eb) && !isnan(ea);
    }
    return ea <= eb && ta <= tb && (ea < eb || ta < tb);
}

void glint_speed_error_compare(glint_rung_result *rungs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        int *by = &rungs[i].dominated_by;
        *by = -1;
        for (size_t k = 0; k < count; k++) {
            if (k != i && dominates(&rungs[k], &rungs[i]) &&
                (*by < 0 || rungs[k].kernel.median < rungs[*by].kernel.median)) {
                *by = (int)k;
            }
        }
    }
}

// ---- Sampling ----------------------------------------------------------------------------------

static glint_status render_samples(run *r, const glint_settings *settings, glint_image *image,
                                   times *t, glint_error *error)
{
    glint_renderer *own = NULL, *renderer;
    glint_frame_report report;
    glint_status status;
    TRY_OR(cleanup, status, provide(r, settings, &own, &renderer, error));
    const int frames = t != NULL ? 4 : 1;
    for (int i = 0; i < frames; i++) {
        TRY_OR(cleanup, status, render(r, renderer, image, &report, error));
        if (i > 0) { // the first frame warms up
            TRY_OR(cleanup, status, keep_time(t, report.kernel_ms, error));
        }
    }
cleanup:
    glint_renderer_free(own);
    return status;
}

static glint_settings with_samples(const run *r, int axis, bool is_mip)
{
    glint_settings settings = *r->inputs->settings;
    settings.samples_per_axis = axis;
    settings.filter = is_mip ? GLINT_FILTER_MIP : GLINT_FILTER_BILINEAR;
    return settings;
}

// Times and judges `axis` × `axis` samples per pixel, with the filter of *row.
static glint_status judge_samples(run *r, int axis, const glint_image *truth,
                                  glint_sampling_result *row, glint_error *error)
{
    const glint_settings settings = with_samples(r, axis, row->is_mip);
    times t = {0};
    row->samples = axis * axis;
    show(r, "rendering ", row->is_mip ? "with the mip filter" : "with more samples");
    glint_status status;
    TRY_OR(cleanup, status, render_samples(r, &settings, &r->again, &t, error));
    row->kernel = glint_summarize(t.values, t.count);
    status = glint_metrics_find(&r->again, truth, NULL, &row->error, error);
cleanup:
    free(t.values);
    return status;
}

// Measures the error of sampling: compares few samples with TRUTH_SAMPLES times as many on each
// axis.
static glint_status judge_sampling(run *r, glint_error *error)
{
    static const struct {
        int times;
        bool is_mip;
    } rows[GLINT_SAMPLING_ROWS] = {{1, false}, {1, true}, {2, false}, {4, false}};
    const int base = r->inputs->settings->samples_per_axis;
    const int axis = base * TRUTH_SAMPLES;
    if (r->options->no_sampling || axis > GLINT_SAMPLES_PER_AXIS_MAX) {
        return GLINT_OK;
    }
    const glint_settings settings = with_samples(r, axis, false);
    glint_image truth = {0};
    show(r, "rendering ", "with very many samples");
    r->result->sampling_truth = axis * axis;
    glint_status status;
    TRY_OR(cleanup, status, render_samples(r, &settings, &truth, NULL, error));
    for (int i = 0; i < GLINT_SAMPLING_ROWS; i++) {
        glint_sampling_result *row = &r->result->sampling[i];
        row->is_mip = rows[i].is_mip;
        TRY_OR(cleanup, status, judge_samples(r, base * rows[i].times, &truth, row, error));
    }
cleanup:
    glint_image_free(&truth);
    return status;
}

// ------------------------------------------------------------------------------------------------

static glint_status measure(run *r, glint_error *error)
{
    static glint_status (*const steps[])(run *, glint_error *) = {
        open_device, make_ladder, render_reference, judge, time_rungs, judge_sampling};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        TRY(steps[i](r, error));
    }
    glint_speed_error_compare(r->result->rungs, r->result->count);
    if (r->options->pictures) {
        r->result->reference_picture = r->reference;
        r->reference = (glint_image){0};
    }
    return GLINT_OK;
}

glint_status glint_speed_error_measure(const glint_bench_inputs *inputs,
                                       const glint_speed_error_options *options,
                                       const glint_bench_watcher *watcher,
                                       glint_speed_error_result *result, glint_error *error)
{
    *result = (glint_speed_error_result){0};
    run r = {.inputs = inputs, .options = options, .watcher = *watcher, .result = result};
    glint_status status = measure(&r, error);
    for (size_t i = 0; i < RENDERERS; i++) {
        glint_renderer_free(r.own[i]);
        free(r.times[i].values);
    }
    glint_renderer_free(r.shared);
    glint_layers_free(&r.reference_layers);
    glint_image_free(&r.reference);
    glint_image_free(&r.again);
    glint_device_close(r.device);
    return status;
}

void glint_speed_error_free(glint_speed_error_result *result)
{
    for (size_t i = 0; i < GLINT_RUNGS_MAX; i++) {
        glint_image_free(&result->rungs[i].picture);
        glint_image_free(&result->rungs[i].heat);
    }
    glint_image_free(&result->reference_picture);
    *result = (glint_speed_error_result){0};
}
