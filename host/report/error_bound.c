// Frames whose error stays within a bound. See error_bound.h.
//
// A grid of some thousand pixels tells the mean of an error well as long as it is spread over many
// pixels. Some things are not, and each is met in its own way:
//  - Where light bounces so often between curved surfaces that single precision has no digits left,
//    one pixel in ten thousand is off by many times the mean. How likely that is of the grid's
//    pixels is found in double precision (error_grid.h), and those are taken to show what another
//    direction of the environment would: `chaos`.
//  - Near critical angles reflectance has no slope that digits could be counted on: in glass single
//    precision is taken to add FLOAT_IN_GLASS whatever the grid shows.
//  - What truncation takes from a few pixels alone: the kernels add up the squares of what each
//    pixel was cut short of, of the whole frame. More than the grid's pixels had is taken to err by
//    as much for its weight as anything that was seen, where paths split; where they do not, and
//    depth is what cuts them short, as another direction would. A frame that then exceeds the bound
//    is rendered again.
//  - What is cut short mostly shows another direction than what it would have shown, by a fifth to
//    the whole of the environment's contrast; but it may also be right nearly everywhere, as of an
//    open sea, and wrong in two pixels of a frame. So truncated weight is never taken to err by
//    less than LEAST_TRUNCATION of that.
//  - Chance: that of error_grid.h, and a safety factor.
// The reference keeps every bound, as errors are counted from it.
#include "report/error_bound.h"

#include "base/clock.h"
#include "report/error_grid.h"
#include "report/metrics.h"
#include "report/stats.h"

#include <math.h>
#include <stdio.h>

#define SAFETY 1.05 // beside chance
// Where no path splits a rung of fewer surfaces is taken if it has no more than this share of rays.
#define SHALLOW_RAYS 0.9
// Surfaces after which single precision may have no digits left: light that glass focuses as it
// passes loses a digit at each or at every other one.
#define CHAOS_DEPTH 12
// By 1 what follows of it is 0.65 to 5 times what single precision errs by, of 12 views of three
// scenes of curved glass (built-in glass and mixed, gallery), and more of others.
#define CHAOS_FACTOR 2
// One pixel that shows what its neighbour does, at a fold of curved glass: of 36 views (640 x 352)
// of nine scenes without chaos the sea's had the most, 9.6e-4, and no grid can tell.
#define FLOAT_IN_GLASS 1e-3
// Of what another direction would make of the truncated weight: ten scenes' frames have 0.15 to 1
// of it, with weights of 1/4 to 1/4096, where more than two pixels err.
#define LEAST_TRUNCATION 0.25
// The grid's own reference may end branches of the bound over this: what that leaves out is some
// hundredths of the bound.
#define REFERENCE_SHARE 256
// Half texels err by up to some 10⁻⁴ (render/plan.c).
#define HALF_TEXELS_FROM 1e-3
// Least weights are 2^(−step/2).
#define COARSE_STEP 12 // 1/64
#define LAST_STEP 32   // the reference's
// How the error falls: as about the 0.8th power of the weight.
#define OCTAVES_PER_STEP 0.4
// In double precision a frame takes what it takes in float with a quarter of the weight, about.
#define DOUBLE_STEPS 4
#define FRAMES_BEFORE_REFERENCE 2 // that turned out to err by too much
#define RUNGS 8

typedef struct search {
    const glint_error_bound *bound;
    glint_error_grid grid;
    bool splits, glass;          // paths split; there is glass
    double another;              // by how much light from another direction differs, over the mean
    double reference_truncation; // of the grid, see glint_truncation.rms
    double chaos;                // what single precision is taken to add beyond what the grid shows
    double contrast;             // `another`, as radiance
    uint32_t deepest;            // surfaces of a path of the grid's reference
    uint64_t rays;               // likewise
    double per_weight;           // the largest error seen, for each truncated weight
} search;

// A rung that has been tried.
typedef struct trial {
    glint_rung rung;
    double error;          // at most, with chaos
    glint_grid_error grid; // without
    double truncation;     // of the grid, see glint_truncation.rms
    uint64_t rays;         // likewise
} trial;

void glint_error_bound_begin(glint_error_bound *bound, double max_error,
                             const glint_settings *settings)
{
    *bound = (glint_error_bound){.bound = max_error, .settings = *settings};
}

void glint_error_bound_set_environment(glint_error_bound *bound, const glint_cube *environment)
{
    double sum[3] = {0}, squares = 0, all = 0;
    const int edge = environment->edge;
    for (int i = 0; i < 6 * edge * edge; i++) {
        const int column = i % edge, row = i / edge % edge;
        const double x = (2.0 * column + 1) / edge - 1, y = (2.0 * row + 1) / edge - 1;
        const double distance = 1 + x * x + y * y;                  // squared
        const double solid_angle = 1 / (distance * sqrt(distance)); // but for a factor
        const float *texel = glint_cube_texel(environment, i / (edge * edge), column, row);
        all += solid_angle;
        for (int c = 0; c < 3; c++) {
            sum[c] += solid_angle * (double)texel[c];
            squares += solid_angle * (double)texel[c] * (double)texel[c] / 3;
        }
    }
    const double means = (sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / (3 * all * all);
    bound->contrast = all > 0 ? sqrt(fmax(0, squares / all - means)) : 0;
}

static bool keeps(const search *s, const trial *t)
{
    const double factor = s->grid.step > 1 ? SAFETY : 1;
    return factor * t->error <= s->bound->bound;
}

// A picture that is dark at all of a sparse grid's places says nothing of what lies between them.
static bool is_blind(const search *s)
{
    return s->grid.step > 1 && s->grid.mean == 0;
}

// What is truncated that the reference follows cannot be taken to err by less; 0 where the grid is
// the frame.
static double least_error(const search *s, double truncation)
{
    const double of_reference = s->reference_truncation;
    const double more = truncation * truncation - of_reference * of_reference;
    return LEAST_TRUNCATION * s->another * sqrt(fmax(0, more));
}

static double with_chaos(const search *s, const glint_rung *rung, double error)
{
    return rung->settings.precision == GLINT_PRECISION_FLOAT ? hypot(error, s->chaos) : error;
}

static glint_status try_rung(search *s, const glint_rung *rung, trial *t, glint_error *error)
{
    glint_frame_report report;
    *t = (trial){.rung = *rung};
    glint_status status =
        glint_error_grid_measure(&s->grid, &rung->settings, &t->grid, &report, error);
    if (status == GLINT_OK) {
        t->truncation = report.truncation.rms;
        t->error = with_chaos(s, rung, fmax(t->grid.at_most, least_error(s, t->truncation)));
        t->rays = glint_stats_rays(&report.rays);
        if (t->truncation > 0 && t->grid.measured < (double)INFINITY) {
            s->per_weight = fmax(s->per_weight, t->grid.measured / t->truncation);
        }
    }
    return status;
}

static void take_reference(const search *s, trial *t)
{
    *t = (trial){0};
    glint_rung_reference(&s->bound->settings, &t->rung);
}

// What single precision is up against, where it may be taken at all. `image` is the grid by
// `settings`, in double precision.
static glint_status find_chaos(search *s, const glint_image *image, const glint_settings *settings,
                               glint_error *error)
{
    double share;
    if (s->another == 0 || s->deepest <= CHAOS_DEPTH || SAFETY * s->chaos > s->bound->bound) {
        return GLINT_OK;
    }
    glint_status status = glint_error_grid_find_chaos(&s->grid, image, settings, CHAOS_DEPTH,
                                                      s->contrast, &share, error);
    if (status == GLINT_OK) {
        s->chaos = hypot(s->chaos, CHAOS_FACTOR * s->another * sqrt(share));
    }
    return status;
}

// ---- Where paths split -------------------------------------------------------------------------

// 2^(−step/2) to three digits, so that the options that are told of make the same picture.
static double weight_of(int step)
{
    const double weight = exp2(-0.5 * step), digits = pow(10, 2 - floor(log10(weight)));
    return round(weight * digits) / digits;
}

static int step_of(double weight)
{
    return (int)lround(-2 * log2(weight));
}

// Branches below a weight are not followed.
static glint_rung weights(const search *s, glint_precision precision, int step)
{
    const bool is_float = precision == GLINT_PRECISION_FLOAT;
    const bool coarse = s->bound->bound >= HALF_TEXELS_FROM;
    glint_rung rung;
    glint_rung_by_weight(&s->bound->settings, precision,
                         is_float && !coarse ? GLINT_TEXELS_FLOAT : GLINT_TEXELS_AUTO,
                         weight_of(step), &rung);
    return rung;
}

static glint_status try_weights(search *s, glint_precision precision, int step, trial *t,
                                glint_error *error)
{
    const glint_rung rung = weights(s, precision, step);
    return try_rung(s, &rung, t, error);
}

// Steps to an error within the bound, from one that is `error`.
static double steps_from(const search *s, double error)
{
    return log2(SAFETY * error / s->bound->bound) / OCTAVES_PER_STEP;
}

// In double precision, from what was tried first: *step is LAST_STEP where nothing but the
// reference will do.
static glint_status find_weights(search *s, const trial *first, int *step, trial *best,
                                 glint_error *error)
{
    int failing = 1, at = COARSE_STEP;
    trial t = *first;
    *step = LAST_STEP;
    for (;;) {
        if (keeps(s, &t)) {
            *step = at;
            *best = t;
        } else {
            failing = at;
        }
        const double next = ceil(at + steps_from(s, t.error));
        if (keeps(s, &t) && next >= *step) {
            return GLINT_OK; // there is no room for larger weights
        }
        at = next > failing ? next < *step ? (int)next : *step - 1 : failing + 1;
        if (at <= failing || at >= *step) {
            return GLINT_OK;
        }
        const glint_status status = try_weights(s, GLINT_PRECISION_DOUBLE, at, &t, error);
        if (status != GLINT_OK) {
            return status;
        }
    }
}

// Single precision errs by what double precision does and more, so that it needs no larger weights;
// it is worth its while with weights that are smaller by less than what it is faster.
static glint_status try_float(search *s, int of_double, trial *best, glint_error *error)
{
    const int last = of_double + DOUBLE_STEPS < LAST_STEP ? of_double + DOUBLE_STEPS : LAST_STEP;
    double expected = best->error;
    int at = of_double;
    for (; at < last && SAFETY * hypot(expected, s->chaos) > s->bound->bound; at++) {
        expected *= exp2(-OCTAVES_PER_STEP);
    }
    glint_status status = GLINT_OK;
    for (; status == GLINT_OK && at < last; at++) {
        trial t;
        status = try_weights(s, GLINT_PRECISION_FLOAT, at, &t, error);
        if (status == GLINT_OK && keeps(s, &t)) {
            *best = t;
            break;
        }
    }
    return status;
}

static glint_status search_weights(search *s, trial *best, glint_error *error)
{
    trial first;
    int step = LAST_STEP;
    take_reference(s, best);
    glint_status status = try_weights(s, GLINT_PRECISION_DOUBLE, COARSE_STEP, &first, error);
    if (status == GLINT_OK) {
        status = find_chaos(s, &s->grid.image, &first.rung.settings, error);
    }
    if (status == GLINT_OK) {
        status = find_weights(s, &first, &step, best, error);
    }
    return status == GLINT_OK && step < LAST_STEP ? try_float(s, step, best, error) : status;
}

// ---- Where they do not -------------------------------------------------------------------------

// In the order of what they cost.
static size_t list_rungs(const search *s, const glint_plan *plan, glint_rung rungs[RUNGS])
{
    const glint_settings *settings = &s->bound->settings;
    size_t count = 0;
    for (int depth = 1; depth <= 8 && depth < plan->depth; depth *= 2) {
        glint_rung_by_depth(settings, depth, &rungs[count++]);
    }
    if (settings->texels == GLINT_TEXELS_AUTO) {
        glint_rung_by_depth(settings, 0, &rungs[count++]);
    }
    glint_rung *floats = &rungs[count++], *doubles = &rungs[count++];
    *floats = *doubles = (glint_rung){.settings = *settings};
    floats->settings.texels = GLINT_TEXELS_FLOAT;
    snprintf(floats->name, sizeof floats->name, "float texels");
    snprintf(floats->options, sizeof floats->options, "--texels float");
    doubles->settings.precision = GLINT_PRECISION_DOUBLE;
    snprintf(doubles->name, sizeof doubles->name, "double precision");
    snprintf(doubles->options, sizeof doubles->options, "--precision double");
    return count;
}

// The first that keeps the bound, from the `first`th on.
static glint_status search_rungs(search *s, const glint_rung *rungs, size_t first, size_t count,
                                 size_t *taken, trial *best, glint_error *error)
{
    glint_status status = GLINT_OK;
    for (*taken = first; status == GLINT_OK && *taken < count; (*taken)++) {
        status = try_rung(s, &rungs[*taken], best, error);
        const bool is_shallow = rungs[*taken].settings.depth > 0;
        if (status == GLINT_OK && keeps(s, best) &&
            (!is_shallow || (double)best->rays <= SHALLOW_RAYS * (double)s->rays)) {
            return status;
        }
    }
    take_reference(s, best);
    return status;
}

// ---- The frame ---------------------------------------------------------------------------------

static glint_status search_all_rungs(search *s, const glint_rung *rungs, size_t count,
                                     size_t *taken, trial *best, glint_error *error)
{
    glint_rung reference;
    glint_rung_reference(&s->bound->settings, &reference);
    glint_status status = find_chaos(s, &s->grid.reference, &reference.settings, error);
    return status == GLINT_OK ? search_rungs(s, rungs, 0, count, taken, best, error) : status;
}

// The grid's reference, and what it tells of the frame.
static glint_status look(search *s, glint_error *error)
{
    const glint_error_bound *b = s->bound;
    glint_error_grid *grid = &s->grid;
    glint_frame_report report;
    glint_rung reference;
    glint_rung_reference(&b->settings, &reference);
    // A grid that is the frame is a small one, and has time for all.
    const double least = grid->step > 1 ? b->bound / REFERENCE_SHARE : 0;
    reference.settings.min_weight = fmax(reference.settings.min_weight, least);
    glint_status status = glint_error_grid_render(grid, &reference.settings, grid->camera,
                                                  &grid->reference, &report, error);
    if (status != GLINT_OK) {
        return status;
    }
    s->rays = glint_stats_rays(&report.rays);
    s->deepest = report.deepest;
    s->reference_truncation = report.truncation.rms;
    grid->mean = glint_metrics_mean(&grid->reference, &grid->reference);
    if (grid->mean == 0 || grid->step == 1) {
        return GLINT_OK;
    }
    // Of what shines itself, paint and lamps in the scene, the picture tells.
    s->contrast = fmax(b->contrast, glint_error_grid_contrast(grid));
    s->another = s->contrast / fabs(grid->mean);
    s->chaos = s->glass ? FLOAT_IN_GLASS : 0;
    s->per_weight = s->splits ? 0 : s->another;
    return GLINT_OK;
}

static bool is_reference(const search *s, const glint_rung *rung)
{
    glint_rung reference;
    glint_rung_reference(&s->bound->settings, &reference);
    return rung->settings.depth == reference.settings.depth &&
           rung->settings.min_weight == reference.settings.min_weight &&
           rung->settings.precision == reference.settings.precision;
}

// What a frame errs by: what its pixels were cut short of beyond what the grid's were is taken to
// err by as much for its weight as anything that was seen.
static double estimate_of(const search *s, const trial *t, double whole)
{
    const double seen = t->truncation;
    if (s->grid.step == 1 || is_reference(s, &t->rung)) {
        return t->error;
    }
    const double unseen = s->per_weight * sqrt(fmax(0, whole * whole - seen * seen));
    const double known = fmax(t->grid.at_most, hypot(t->grid.measured, unseen));
    return with_chaos(s, &t->rung, fmax(known, least_error(s, whole)));
}

static glint_status render(search *s, const trial *t, glint_image *image,
                           glint_frame_report *report, double *estimate, glint_error *error)
{
    glint_error_grid *grid = &s->grid;
    glint_settings settings = t->rung.settings;
    settings.truncation_squares = true;
    glint_status status = glint_renderer_set_settings(grid->renderer, &settings, error);
    if (status == GLINT_OK) {
        status = glint_renderer_frame(grid->renderer, grid->camera, grid->progress, image, report,
                                      error);
    }
    if (status == GLINT_OK) {
        *estimate = estimate_of(s, t, report->truncation.rms);
    }
    return status;
}

// A finer rung than one whose frame turned out to err by `estimate`.
static glint_status refine_frame(search *s, double estimate, const glint_rung *rungs, size_t count,
                                 size_t *taken, trial *t, glint_error *error)
{
    if (!s->splits) {
        return search_rungs(s, rungs, *taken + 1, count, taken, t, error);
    }
    const double by = fmin(LAST_STEP, log2(estimate / s->bound->bound) / OCTAVES_PER_STEP);
    const int step = step_of(t->rung.settings.min_weight) + (int)ceil(fmax(1, by));
    if (step >= LAST_STEP) {
        take_reference(s, t);
        return GLINT_OK;
    }
    return try_weights(s, t->rung.settings.precision, step, t, error);
}

static glint_status choose(search *s, const glint_rung *rungs, size_t count, size_t *taken,
                           trial *t, glint_error *error)
{
    glint_status status = look(s, error);
    if (status != GLINT_OK) {
        return status;
    }
    if (is_blind(s)) {
        take_reference(s, t);
        return GLINT_OK;
    }
    return s->splits ? search_weights(s, t, error)
                     : search_all_rungs(s, rungs, count, taken, t, error);
}

static glint_status choose_and_render(search *s, glint_image *image, glint_frame_report *report,
                                      glint_error_choice *choice, glint_error *error)
{
    // The plan is that of the frame before otherwise.
    glint_status status = glint_renderer_set_settings(s->grid.renderer, &s->bound->settings, error);
    if (status != GLINT_OK) {
        return status;
    }
    const glint_plan plan = *glint_renderer_plan(s->grid.renderer);
    glint_rung rungs[RUNGS];
    s->splits = plan.features[GLINT_FEATURE_SPLIT].compiled;
    s->glass = plan.features[GLINT_FEATURE_GLASS].compiled;
    const size_t count = s->splits ? 0 : list_rungs(s, &plan, rungs);
    size_t taken = 0;
    trial t = {0};
    double begun = glint_now_ms(), estimate = INFINITY;
    status = choose(s, rungs, count, &taken, &t, error);
    for (choice->frames = 1; status == GLINT_OK; choice->frames++) {
        choice->choosing_ms += glint_lap_ms(&begun);
        status = render(s, &t, image, report, &estimate, error);
        if (status != GLINT_OK || estimate <= s->bound->bound) {
            break;
        }
        if (choice->frames == FRAMES_BEFORE_REFERENCE) {
            take_reference(s, &t);
        } else {
            status = refine_frame(s, estimate, rungs, count, &taken, &t, error);
        }
    }
    choice->rung = t.rung;
    choice->error = estimate;
    choice->grid_error = t.grid.measured;
    choice->chaos = t.rung.settings.precision == GLINT_PRECISION_FLOAT ? s->chaos : 0;
    return status;
}

glint_status glint_error_bound_frame(const glint_error_bound *bound, glint_renderer *renderer,
                                     const glint_camera *camera, const glint_progress *progress,
                                     glint_image *image, glint_frame_report *report,
                                     glint_error_choice *choice, glint_error *error)
{
    const glint_settings *settings = &bound->settings;
    search s = {
        .bound = bound,
        .grid = {.renderer = renderer,
                 .camera = camera,
                 .progress = progress,
                 .step = glint_error_grid_step(settings->width, settings->height)},
    };
    *choice = (glint_error_choice){.bound = bound->bound, .grid_is_frame = s.grid.step == 1};
    glint_status status = choose_and_render(&s, image, report, choice, error);
    choice->grid_pixels = (int)glint_error_grid_pixel_count(&s.grid);
    choice->grids = s.grid.pictures;
    choice->choosing_rays = s.grid.rays;
    glint_error_grid_free(&s.grid);
    return status;
}
