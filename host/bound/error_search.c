// Searches for the cheapest settings whose error keeps a bound. See error_search.h.
//
// A grid of a few thousand pixels gives a good estimate of the mean error if the error is spread
// over many pixels. Some errors are not, and each of them has its own treatment:
//  - Single precision, which fails in rare pixels: see error_unseen.c.
//  - Truncation that affects only a few pixels: the kernels add up the squared truncated weights
//    of all pixels of the frame (with_truncated). A frame that then exceeds the bound is rendered
//    again.
//  - Truncated light mostly shows another direction than the full path would. Its error is a fifth
//    to the whole of the environment's contrast. But it may also be right nearly everywhere, as
//    for an open sea, and wrong in two pixels of a frame. So the error of truncated weight is
//    never assumed to be less than LEAST_TRUNCATION of the contrast.
//  - The mean that errors are relative to: the mean of the frame itself, once it has been
//    rendered.
//  - Chance: the upper bound of error_grid.h, and a safety factor. Only the choice uses the safety
//    factor; the reported error does not.
// The reference keeps every bound, because errors are measured against it.
#include "bound/error_search.h"

#include "bound/error_unseen.h"
#include "image/metrics.h"

#include <math.h>
#include <stdio.h>

// If no path splits, a rung with a smaller depth is only taken if its share of the rays is at most
// this.
#define SHALLOW_RAYS 0.9
// The least error of truncated weight, relative to the error that another direction would make. The
// frames of ten scenes have 0.15 to 1 of this error, with least weights of 1/4 to 1/4096, if more
// than two pixels are wrong. If only a few pixels are wrong, as in nested glass with 1/16000, a
// frame had 0.35 and its grid 0.09.
#define LEAST_TRUNCATION 0.35
// ALIKE: the frame may have this times the grid's truncated weight, and its errors still scale with
// the grid's errors. UNLIKE: the largest error of the rest, relative to the error that another
// direction would make.
#define ALIKE 2
#define UNLIKE 2
// The reference of the grid may end branches below a weight of the bound divided by this. The
// omitted light is a few hundredths of the bound.
#define REFERENCE_SHARE 256
// Half texels have errors of up to about 10⁻⁴ (render/plan_device.c).
#define HALF_TEXELS_FROM 1e-3
// Step s stands for the least weight 2^(−s/2).
// 1/64: the finest weights that the search for chaos in single precision uses.
#define CHAOS_STEP 12
#define LAST_STEP 32 // step of the reference
// The first guess: FIRST_STEP for a bound of 0.1, and STEPS_PER_TENTH more for each tenth of it.
#define FIRST_STEP 8
#define STEPS_PER_TENTH 6
// How fast the error falls: about as the 0.8th power of the weight, within these limits.
#define OCTAVES_PER_STEP 0.4
#define OCTAVES_PER_STEP_LEAST 0.2
#define OCTAVES_PER_STEP_MOST 0.8
// Stop the search if failing weights take this share of the rays of passing weights: weights
// between them save nothing.
#define USELESS_RAYS 0.99
// If fewer steps than this are left before the reference, double precision takes nearly as long as
// the reference.
#define NEAR_STEPS 4
// A frame in double precision takes about as long as in float with a quarter of the weight, or with
// half of the weight if mended.
#define DOUBLE_STEPS 4
#define MENDED_STEPS 3
// Mending may take this share of the rays of a frame in double precision. Single precision takes
// about 0.4 of the time of double precision, and a pixel of a list takes a third more than other
// pixels.
#define MOST_MENDED 0.35

static bool keeps(const glint_error_search *s, const glint_error_trial *t)
{
    const double factor = s->grid.step > 1 ? GLINT_ERROR_SAFETY : 1;
    return factor * t->error <= s->asked->bound;
}

// True if the picture is black at all pixels of a sparse grid. It then tells nothing about the
// pixels between them.
static bool is_blind(const glint_error_search *s)
{
    return s->grid.step > 1 && s->grid.mean == 0;
}

// The least error of weight that is truncated here but not in the reference. 0 if the grid is the
// frame.
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

// ---- Search by weights, if paths split ---------------------------------------------------------

// 2^(−step/2), rounded to three digits, so that the reported options make the same picture.
static double weight_of(int step)
{
    const double weight = exp2(-0.5 * step), digits = pow(10, 2 - floor(log10(weight)));
    return round(weight * digits) / digits;
}

static int step_of(double weight)
{
    return (int)lround(-2 * log2(weight));
}

// How branches above the least weight are followed.
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

// Weights in double precision that were tried.
typedef struct tried {
    int step; // initially LAST_STEP (keeping) and 1 (failing)
    double error;
    uint64_t rays;
} tried;

// The largest weights that keep the bound, the smallest weights known to fail, and the last
// weights.
typedef struct bracket {
    tried keeping, failing, last;
    double octaves_per_step; // decrease of the error, in octaves per step
    bool halve;              // the last step left most of the interval
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

// The step between the two at which the error meets the bound, by linear interpolation.
static double step_between(const glint_error_search *s, const bracket *b)
{
    const double fall = log2(b->failing.error / b->keeping.error);
    const double above = log2(GLINT_ERROR_SAFETY * b->failing.error / s->asked->bound);
    const bool is_known = b->keeping.error > 0 && b->failing.error < (double)INFINITY;
    return is_known && !b->halve ? b->failing.step + above / fall * width_of(b)
                                 : b->failing.step + 0.5 * width_of(b);
}

// The step to try next. Returns the step that keeps the bound if no other step is expected to do
// better.
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

// Finds the largest weights in double precision that keep the bound, and keeps their picture. *step
// is LAST_STEP if only the reference keeps the bound.
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

// Estimates the unseen errors of single precision with these weights. For long paths, uses the
// weights of CHAOS_STEP if the weights are finer.
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

// Tries single precision. It has the error of double precision and more, so it never allows larger
// weights. It pays if the weights it needs are smaller by less than its gain in speed.
static glint_status try_float(glint_error_search *s, double mend, int of_double,
                              glint_error_trial *best, glint_error *error)
{
    const int more = mend > 0 ? MENDED_STEPS : DOUBLE_STEPS;
    const int last = of_double + more < LAST_STEP ? of_double + more : LAST_STEP;
    const double unseen = mend > 0 ? s->mended_unseen : s->unseen;
    double expected = best->error;
    // Skip weights that are expected to fail.
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

// Finds whether mending pays compared with a frame in double precision. `settings` render this
// frame, and `rays` are the rays of its grid.
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

// Tries finer weights in the same precision on the grid. If they take nearly as long as the
// reference, takes the reference.
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

// ---- Search by rungs, if paths do not split ----------------------------------------------------

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

// Prepares the finest rung in single precision with mending, and finds whether it pays.
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

// Finds the first rung from `taken` on that keeps the bound.
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

// Collects what the grid's reference tells about the frame, except its mean.
static void learn(glint_error_search *s)
{
    const glint_frame_report *report = &s->grid.report;
    s->rays = glint_ray_counts_all(&report->rays);
    s->deepest = report->deepest;
    s->truncation = report->truncation.rms;
    if (s->grid.mean != 0 && s->grid.step > 1) {
        // The picture tells about light that comes from the scene itself, such as paint and lamps.
        s->contrast = fmax(s->asked->contrast, glint_error_grid_contrast(&s->grid));
        s->relative_contrast = s->contrast / fabs(s->grid.mean);
        s->unseen = s->mended_unseen = s->glass ? GLINT_ERROR_FLOAT_IN_GLASS : 0;
    }
}

// Chooses exact lobes if the lobes of the settings take half of the bound.
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
    if (s->grid.step > 1) { // a grid that is the frame is small and has time for all branches
        const double least = fmin(1, asked->bound / REFERENCE_SHARE);
        s->of_reference.min_weight = fmax(s->of_reference.min_weight, least);
    }
    if (plan->features[GLINT_FEATURE_CONVEX_SOLID].compiled) {
        s->of_reference.depth = 0; // auto, so that its truncation is comparable with other settings
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

// Estimates a frame's error from its truncated weight `whole` (RMS) and the error of the grid. If
// no path splits, the depth truncates. The weight that exceeds the grid's then counts as if it
// showed another direction. If paths split, up to ALIKE times the grid's weight counts with the
// error that the grid has for its weight. The rest, of pixels unlike those of the grid, counts as
// UNLIKE times the error of another direction.
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

// The reference's mean over the whole frame, divided by its mean over the grid. The frame's mean is
// corrected by the frame's error on the grid.
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
