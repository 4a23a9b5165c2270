// The search for the cheapest way of rendering that keeps a bound. See error_search.h.
//
// A grid of some thousand pixels tells the mean of an error well as long as it is spread over many
// pixels. Some things are not, and each is met in its own way:
//  - What single precision makes of a pixel here and there: error_unseen.c.
//  - What truncation takes from a few pixels alone: the kernels add up the squares of what each
//    pixel was cut short of, of the whole frame (with_truncated). A frame that then exceeds the
//    bound is rendered again.
//  - What is cut short mostly shows another direction than what it would have shown, by a fifth to
//    the whole of the environment's contrast; but it may also be right nearly everywhere, as of an
//    open sea, and wrong in two pixels of a frame. So truncated weight is never taken to err by
//    less than LEAST_TRUNCATION of that.
//  - The mean that errors are relative to: that of the frame itself, once there is one.
//  - Chance: that of error_grid.h, and a safety factor, which only the choice heeds: what is said
//    of the frame is without.
// The reference keeps every bound, as errors are counted from it.
#include "bound/error_search.h"

#include "bound/error_unseen.h"
#include "image/metrics.h"

#include <math.h>
#include <stdio.h>

// Where no path splits a rung of fewer surfaces is taken if it has no more than this share of rays.
#define SHALLOW_RAYS 0.9
// Of what another direction would make of the truncated weight: ten scenes' frames have 0.15 to 1
// of it, with weights of 1/4 to 1/4096, where more than two pixels err. Where few do, as in nested
// glass with 1/16000, a frame had 0.35 of it and its grid 0.09.
#define LEAST_TRUNCATION 0.35
// Of truncated weight, how much more there may be of a frame than of the grid for its errors to be
// alike; and what others err by at their worst, of what another direction would make of it.
#define ALIKE 2
#define UNLIKE 2
// The grid's own reference may end branches of the bound over this: what that leaves out is some
// hundredths of the bound.
#define REFERENCE_SHARE 256
// Half texels err by up to some 10⁻⁴ (render/plan_device.c).
#define HALF_TEXELS_FROM 1e-3
// Least weights are 2^(−step/2).
#define CHAOS_STEP 12 // 1/64: what single precision errs by is looked for with no finer weights
#define LAST_STEP 32  // the reference's
// What is tried first: for a bound of 0.1, and how much finer for a tenth of it.
#define FIRST_STEP 8
#define STEPS_PER_TENTH 6
// How the error falls: as about the 0.8th power of the weight, and between these.
#define OCTAVES_PER_STEP 0.4
#define OCTAVES_PER_STEP_LEAST 0.2
#define OCTAVES_PER_STEP_MOST 0.8
// Weights that fail with this share of the rays of those that keep the bound: what lies between
// saves nothing.
#define USELESS_RAYS 0.99
// So many steps before the reference's a frame in double precision takes nearly as long as it.
#define NEAR_STEPS 4
// In double precision a frame takes what it takes in float with a quarter of the weight, about;
// mended with half of it.
#define DOUBLE_STEPS 4
#define MENDED_STEPS 3
// Of the rays of a frame in double precision, how many mending may take: single precision takes
// about 0.4 of its time, and what is listed a third more than what is not.
#define MOST_MENDED 0.35

static bool keeps(const glint_error_search *s, const glint_error_trial *t)
{
    const double factor = s->grid.step > 1 ? GLINT_ERROR_SAFETY : 1;
    return factor * t->error <= s->asked->bound;
}

// A picture that is dark at all of a sparse grid's places says nothing of what lies between them.
static bool is_blind(const glint_error_search *s)
{
    return s->grid.step > 1 && s->grid.mean == 0;
}

// What is truncated that the reference follows cannot be taken to err by less; 0 where the grid is
// the frame.
static double least_error(const glint_error_search *s, double truncation)
{
    const double more = truncation * truncation - s->truncation * s->truncation;
    return LEAST_TRUNCATION * s->relative_contrast * sqrt(fmax(0, more));
}

static glint_status try_rung(glint_error_search *s, const glint_rung *rung, glint_error_trial *t,
                             glint_error *error)
{
    *t = (glint_error_trial){.rung = *rung};
    TRY(glint_error_grid_measure(&s->grid, &rung->settings, &t->grid, error));
    const glint_frame_report *report = &s->grid.report;
    t->truncation = report->truncation.rms;
    t->error =
        glint_error_with_unseen(s, rung, fmax(t->grid.at_most, least_error(s, t->truncation)));
    t->rays = glint_ray_counts_all(&report->rays);
    t->deepest = report->deepest;
    return GLINT_OK;
}

void glint_error_search_give_up(const glint_error_search *s, glint_error_trial *t)
{
    *t = (glint_error_trial){.is_reference = true};
    glint_rung_reference(&s->asked->settings, s->rough, &t->rung);
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

// How branches above a weight are followed.
typedef struct way {
    glint_precision precision;
    double mend; // glint_settings.mend
} way;

static const way in_double = {GLINT_PRECISION_DOUBLE, 0};
static const way in_float = {GLINT_PRECISION_FLOAT, 0};

static glint_rung rung_of_step(const glint_error_search *s, way by, int step)
{
    const bool is_float = by.precision == GLINT_PRECISION_FLOAT;
    const bool coarse = s->asked->bound >= HALF_TEXELS_FROM;
    glint_rung rung;
    glint_rung_by_weight(&s->base, by.precision,
                         is_float && !coarse ? GLINT_TEXELS_FLOAT : GLINT_TEXELS_AUTO,
                         weight_of(step), &rung);
    glint_rung_mend(by.mend, &rung);
    return rung;
}

static glint_status try_weights(glint_error_search *s, way by, int step, glint_error_trial *t,
                                glint_error *error)
{
    const glint_rung rung = rung_of_step(s, by, step);
    return try_rung(s, &rung, t, error);
}

// Weights in double precision that have been tried.
typedef struct tried {
    int step; // LAST_STEP and 1 while nothing has been
    double error;
    uint64_t rays;
} tried;

// The largest that keep the bound, the smallest that do not, and the last.
typedef struct bracket {
    tried keeping, failing, last;
    double octaves_per_step; // by which the error falls
    bool halve;              // the last step left most of what lay between
} bracket;

static int width_of(const bracket *b)
{
    return b->keeping.step - b->failing.step;
}

static void take_note(const glint_error_search *s, const glint_error_trial *t, int step, bracket *b)
{
    const int before = width_of(b);
    if (b->last.error > 0 && t->error > 0 && b->last.step != step) {
        const double slope = log2(b->last.error / t->error) / (step - b->last.step);
        b->octaves_per_step = fmin(fmax(slope, OCTAVES_PER_STEP_LEAST), OCTAVES_PER_STEP_MOST);
    }
    b->last = (tried){step, t->error, t->rays};
    *(keeps(s, t) ? &b->keeping : &b->failing) = b->last;
    b->halve = 2 * width_of(b) > before;
}

// Where between the two the bound would be kept, on a straight line.
static double step_between(const glint_error_search *s, const bracket *b)
{
    const double fall = log2(b->failing.error / b->keeping.error);
    const double above = log2(GLINT_ERROR_SAFETY * b->failing.error / s->asked->bound);
    const bool is_known = b->keeping.error > 0 && b->failing.error < (double)INFINITY;
    return is_known && !b->halve ? b->failing.step + above / fall * width_of(b)
                                 : b->failing.step + 0.5 * width_of(b);
}

// The step to try next; the one that keeps the bound where none is expected to do better.
static int next_step(const glint_error_search *s, const bracket *b)
{
    const int first = b->failing.step + 1, last = b->keeping.step - 1;
    const bool has_failed = b->failing.step > 1, has_kept = b->keeping.step < LAST_STEP;
    const double beyond =
        b->last.step +
        log2(GLINT_ERROR_SAFETY * b->last.error / s->asked->bound) / b->octaves_per_step;
    const double next = ceil(has_failed && has_kept ? step_between(s, b) : beyond);
    const bool is_no_use = (double)b->failing.rays >= USELESS_RAYS * (double)b->keeping.rays;
    if (first > last || (has_failed && has_kept && is_no_use) || (has_kept && next > last)) {
        return b->keeping.step;
    }
    return next > first ? next < last ? (int)next : last : first;
}

// The largest weights in double precision, whose picture is kept. *step is LAST_STEP where nothing
// but the reference will do.
static glint_status find_weights(glint_error_search *s, int *step, glint_error_trial *best,
                                 glint_error *error)
{
    const double guess = FIRST_STEP + STEPS_PER_TENTH * log10(0.1 / s->asked->bound);
    bracket b = {
        .keeping.step = LAST_STEP, .failing.step = 1, .octaves_per_step = OCTAVES_PER_STEP};
    int at = (int)fmin(fmax(guess, 2), LAST_STEP - 1);
    for (; at != b.keeping.step; at = next_step(s, &b)) {
        glint_error_trial t;
        TRY(try_weights(s, in_double, at, &t, error));
        take_note(s, &t, at, &b);
        if (b.keeping.step == at) {
            *best = t;
            glint_error_grid_keep(&s->grid, &s->coarsest);
        }
    }
    *step = b.keeping.step;
    return GLINT_OK;
}

// What the grid does not show of single precision, with those weights; of long paths, where the
// weights are finer, with CHAOS_STEP's.
static glint_status find_unseen_of_weights(glint_error_search *s, int step,
                                           const glint_error_trial *best, glint_error *error)
{
    const glint_rung rung = rung_of_step(s, in_float, step);
    s->grid.in_double = &s->coarsest;
    TRY(glint_error_find_edges(s, &s->coarsest, &rung.settings, error));
    if (!glint_error_wants_chaos(s, s->deepest)) {
        return GLINT_OK;
    }
    if (step <= CHAOS_STEP) {
        return glint_error_find_chaos(s, &s->coarsest, best->deepest, &best->rung.settings, error);
    }
    glint_error_trial t;
    TRY(try_weights(s, in_double, CHAOS_STEP, &t, error));
    return glint_error_find_chaos(s, &s->grid.image, t.deepest, &t.rung.settings, error);
}

// Single precision errs by what double precision does and more, so that it needs no larger weights;
// it is worth its while with weights that are smaller by less than what it is faster.
static glint_status try_float(glint_error_search *s, double mend, int of_double,
                              glint_error_trial *best, glint_error *error)
{
    const int more = mend > 0 ? MENDED_STEPS : DOUBLE_STEPS;
    const int last = of_double + more < LAST_STEP ? of_double + more : LAST_STEP;
    const double unseen = mend > 0 ? s->mended_unseen : s->unseen;
    double expected = best->error;
    int at = of_double;
    for (; at < last && GLINT_ERROR_SAFETY * hypot(expected, unseen) > s->asked->bound; at++) {
        expected *= exp2(-OCTAVES_PER_STEP);
    }
    for (; at < last; at++) {
        glint_error_trial t;
        TRY(try_weights(s, (way){GLINT_PRECISION_FLOAT, mend}, at, &t, error));
        if (keeps(s, &t)) {
            *best = t;
            break;
        }
    }
    return GLINT_OK;
}

// Whether mending is worth while beside a frame in double precision, by `settings`, whose grid
// takes so many rays.
static glint_status may_mend(glint_error_search *s, const glint_settings *settings, uint64_t rays,
                             bool *is_worth, glint_error *error)
{
    *is_worth = false;
    if (!(s->mend > 0) || !glint_error_may_be_float(s, s->mend)) {
        return GLINT_OK;
    }
    double mended;
    TRY(glint_error_grid_count_mended(&s->grid, settings, s->mend, &mended, error));
    *is_worth = mended <= MOST_MENDED * (double)rays;
    return GLINT_OK;
}

static glint_status search_weights(glint_error_search *s, glint_error_trial *best,
                                   glint_error *error)
{
    int step;
    glint_error_search_give_up(s, best);
    TRY(find_weights(s, &step, best, error));
    if (best->is_reference) {
        return GLINT_OK;
    }
    TRY(find_unseen_of_weights(s, step, best, error));
    if (glint_error_may_be_float(s, 0)) {
        TRY(try_float(s, 0, step, best, error));
    }
    bool is_worth = best->rung.settings.precision == GLINT_PRECISION_DOUBLE;
    if (is_worth) {
        TRY(may_mend(s, &best->rung.settings, best->rays, &is_worth, error));
    }
    return is_worth ? try_float(s, s->mend, step, best, error) : GLINT_OK;
}

// What is finer in the same precision, by the grid as well; where that takes nearly as long as the
// reference, this.
static glint_status refine_weights(glint_error_search *s, double estimate, glint_error_trial *t,
                                   glint_error *error)
{
    const way by = {t->rung.settings.precision, t->rung.settings.mend};
    const int last = by.precision == GLINT_PRECISION_DOUBLE ? LAST_STEP - NEAR_STEPS : LAST_STEP;
    double step = step_of(t->rung.settings.min_weight);
    do {
        step += ceil(fmax(1, log2(estimate / s->asked->bound) / OCTAVES_PER_STEP));
        if (!(step < last)) {
            glint_error_search_give_up(s, t);
            return GLINT_OK;
        }
        TRY(try_weights(s, by, (int)step, t, error));
        estimate = t->error;
    } while (!keeps(s, t));
    return GLINT_OK;
}

// ---- Where they do not -------------------------------------------------------------------------

static glint_rung *append_rung(glint_error_search *s)
{
    return &s->rungs[s->count++];
}

static void list_rungs(glint_error_search *s, const glint_plan *plan)
{
    for (int depth = 1; depth <= 8 && depth < plan->depth; depth *= 2) {
        glint_rung_by_depth(&s->base, depth, append_rung(s));
    }
    glint_rung_by_depth(&s->base, 0, append_rung(s));
    if (plan->half_texels && s->asked->settings.texels == GLINT_TEXELS_AUTO) {
        glint_rung *floats = append_rung(s);
        glint_rung_of(&s->base, "float texels", "--texels float", floats);
        floats->settings.texels = GLINT_TEXELS_FLOAT;
    }
    s->mended_rung = s->count;
    append_rung(s); // prepare_mended fills it
    glint_rung *doubles = append_rung(s);
    glint_rung_of(&s->base, "double precision", "--precision double", doubles);
    doubles->settings.precision = GLINT_PRECISION_DOUBLE;
}

// The finest in single precision, mended: whether that is worth trying.
static glint_status prepare_mended(glint_error_search *s, bool *is_worth, glint_error *error)
{
    glint_rung *rung = &s->rungs[s->mended_rung];
    *rung = s->rungs[s->mended_rung - 1];
    s->grid.in_double = &s->grid.reference;
    if (s->grid.jumps == NULL) {
        TRY(glint_error_find_edges(s, &s->grid.reference, &rung->settings, error));
    }
    TRY(may_mend(s, &s->of_reference, s->rays, is_worth, error));
    glint_rung_mend(s->mend, rung);
    return GLINT_OK;
}

// The first from `taken` on that keeps the bound.
static glint_status search_rungs(glint_error_search *s, glint_error_trial *best, glint_error *error)
{
    for (; s->taken < s->count; s->taken++) {
        bool is_worth = true;
        if (s->taken == s->mended_rung) {
            TRY(prepare_mended(s, &is_worth, error));
        }
        if (!is_worth) {
            continue;
        }
        TRY(try_rung(s, &s->rungs[s->taken], best, error));
        const bool is_shallow = best->rung.settings.depth > 0;
        if (keeps(s, best) &&
            (!is_shallow || (double)best->rays <= SHALLOW_RAYS * (double)s->rays)) {
            return GLINT_OK;
        }
    }
    glint_error_search_give_up(s, best);
    return GLINT_OK;
}

// ---- The search --------------------------------------------------------------------------------

// What the grid's reference tells of the frame, beside its mean.
static void learn(glint_error_search *s)
{
    const glint_frame_report *report = &s->grid.report;
    s->rays = glint_ray_counts_all(&report->rays);
    s->deepest = report->deepest;
    s->truncation = report->truncation.rms;
    if (s->grid.mean != 0 && s->grid.step > 1) {
        // Of what shines itself, paint and lamps in the scene, the picture tells.
        s->contrast = fmax(s->asked->contrast, glint_error_grid_contrast(&s->grid));
        s->relative_contrast = s->contrast / fabs(s->grid.mean);
        s->unseen = s->mended_unseen = s->glass ? GLINT_ERROR_FLOAT_IN_GLASS : 0;
    }
}

// Exact lobes, where those of the settings take half of the bound.
static glint_status choose_lobes(glint_error_search *s, glint_error *error)
{
    if (!s->rough) {
        return GLINT_OK;
    }
    glint_settings settings = s->of_reference;
    settings.roughness = s->base.roughness;
    glint_grid_error found;
    TRY(glint_error_grid_measure(&s->grid, &settings, &found, error));
    if (!(2 * found.at_most <= s->asked->bound)) { // NaN as well
        s->base.roughness = GLINT_ROUGHNESS_EXACT;
    }
    return GLINT_OK;
}

glint_status glint_error_search_begin(glint_error_search *s, const glint_error_bound *asked,
                                      const glint_plan *plan, glint_error *error)
{
    *s = (glint_error_search){.asked = asked, .grid = s->grid};
    s->splits = plan->features[GLINT_FEATURE_SPLIT].compiled;
    s->glass = plan->features[GLINT_FEATURE_GLASS].compiled;
    s->rough = plan->features[GLINT_FEATURE_ROUGH].compiled;
    s->base = asked->settings;
    glint_rung reference;
    glint_rung_reference(&asked->settings, s->rough, &reference);
    s->of_reference = reference.settings;
    if (s->grid.step > 1) { // one that is the frame is a small one, and has time for all
        const double least = fmin(1, asked->bound / REFERENCE_SHARE);
        s->of_reference.min_weight = fmax(s->of_reference.min_weight, least);
    }
    if (plan->features[GLINT_FEATURE_CONVEX_SOLID].compiled) {
        s->of_reference.depth = 0; // so that what is cut short of it is what may be of others
    }
    TRY(glint_error_grid_set_reference(&s->grid, &s->of_reference, error));
    learn(s);
    TRY(choose_lobes(s, error));
    if (!s->splits) {
        list_rungs(s, plan);
    }
    return GLINT_OK;
}

glint_status glint_error_search_choose(glint_error_search *s, glint_error_trial *t,
                                       glint_error *error)
{
    if (is_blind(s)) {
        glint_error_search_give_up(s, t);
        return GLINT_OK;
    }
    if (s->splits) {
        return search_weights(s, t, error);
    }
    TRY(glint_error_find_edges(s, &s->grid.reference, &s->base, error));
    if (glint_error_wants_chaos(s, s->deepest)) {
        TRY(glint_error_find_chaos(s, &s->grid.reference, s->deepest, &s->of_reference, error));
    }
    return search_rungs(s, t, error);
}

glint_status glint_error_search_refine(glint_error_search *s, double estimate, glint_error_trial *t,
                                       glint_error *error)
{
    if (estimate == (double)INFINITY) {
        glint_error_search_give_up(s, t);
        return GLINT_OK;
    }
    if (s->splits) {
        return refine_weights(s, estimate, t, error);
    }
    s->taken++;
    return search_rungs(s, t, error);
}

// What a frame errs by whose pixels were cut short of `whole`, by what the grid's errs: where no
// path splits, and depth is what cuts them short, more than those as another direction would; else
// up to twice of it by as much for its weight as they do, and the rest, of pixels like which there
// were none, as another direction would at its worst.
static double with_truncated(const glint_error_search *s, const glint_error_trial *t, double whole)
{
    const double seen = t->truncation, measured = t->grid.measured;
    if (!s->splits) {
        return hypot(measured, s->relative_contrast * sqrt(fmax(0, whole * whole - seen * seen)));
    }
    const double alike = seen > 0 ? measured * fmin(fmax(1, whole / seen), ALIKE) : measured;
    const double unlike = sqrt(fmax(0, whole * whole - ALIKE * ALIKE * seen * seen));
    return hypot(alike, UNLIKE * s->relative_contrast * unlike);
}

// The reference's mean over the whole frame, over that of the grid: the frame's, less what it errs
// by on the grid's pixels.
static double mean_over_grids(const glint_error_search *s, const glint_error_trial *t,
                              const glint_image *frame)
{
    const double mean = glint_metrics_mean(frame, frame) - t->grid.mean_error;
    return fabs(mean / s->grid.mean);
}

double glint_error_search_estimate(const glint_error_search *s, const glint_error_trial *t,
                                   const glint_image *frame, const glint_frame_report *report)
{
    if (s->grid.step == 1 || t->is_reference) {
        return t->error;
    }
    if (report->nonfinite_pixels > 0) {
        return (double)INFINITY;
    }
    const double whole = report->truncation.rms;
    const double known = fmax(t->grid.at_most, with_truncated(s, t, whole));
    const double error = glint_error_with_unseen(s, &t->rung, fmax(known, least_error(s, whole)));
    return error == 0 ? 0 : error / mean_over_grids(s, t, frame);
}

void glint_error_search_end(glint_error_search *s)
{
    glint_error_grid_free(&s->grid);
    glint_image_free(&s->coarsest);
    *s = (glint_error_search){0};
}
