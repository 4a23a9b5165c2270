// Estimates errors of single precision in rare pixels. See error_unseen.h.
//
//  - Edges: at edges and folds of glass, and between mirrors that reflect each other, a few pixels
//    show the wrong side of the edge. They may be off by ten times the mean. The number and size
//    of these errors follow from the jumps between the grid's pixels and places beside them
//    (error_grid.h).
//  - Chaos: if light bounces so often between curved surfaces that it has no correct digits left,
//    one pixel in ten thousand is off by many times the mean. Renderings of the grid in double
//    precision tell how likely this is. Such pixels are assumed to show another direction of the
//    environment.
// Both errors occur where the picture jumps. Mending (render/mend.h) can repair the pixels beside
// a jump.
#include "bound/error_unseen.h"

#include <math.h>

// Surfaces after which single precision may have no correct digits left. Light that glass focuses
// loses a digit at every surface, or at every second surface.
#define CHAOS_DEPTH 12
// Safety factor of the estimate. With a factor of 1, the estimate is 0.65 to 5 times the error of
// single precision. This holds for 12 views of three scenes of curved glass (built-in glass and
// mixed, gallery). For other scenes it is larger.
#define CHAOS_FACTOR 2
// If the grid shows no event of a kind, up to this number of events may exist, with a confidence of
// 97.5% (upper bound of a Poisson distribution's mean). If the resulting error takes less than
// AFFORDABLE of the bound, the likelihood need not be found.
#define NONE_SEEN 3.7
#define AFFORDABLE 0.5
// The mean square of the difference between the light of two directions, in squares of the
// contrast.
#define UNRELATED 2
// The share of the bound that edges may take in a mended frame.
#define MENDED_EDGES 0.5
// The share of the chaos error that is left if jumps above MENDED_CONTRAST of the contrast are
// mended. It was measured with 12 frames of the gallery, whose contrast is 5 times the mean. The
// share is 0.37 if jumps of the mean are mended, and 0.10 for jumps of 0.3 of the mean.
#define MENDED_CHAOS 0.25
#define MENDED_CONTRAST 0.1

bool glint_error_may_be_float(const glint_error_search *s, double mend)
{
    const double unseen = mend > 0 ? s->mended_unseen : s->unseen;
    return GLINT_ERROR_SAFETY * unseen <= s->asked->bound;
}

double glint_error_with_unseen(const glint_error_search *s, const glint_rung *rung, double error)
{
    const bool is_float = rung->settings.precision == GLINT_PRECISION_FLOAT;
    return is_float ? hypot(error, rung->settings.mend > 0 ? s->mended_unseen : s->unseen) : error;
}

static bool has_hope(const glint_error_search *s)
{
    return glint_error_may_be_float(s, 0) || (s->mend > 0 && glint_error_may_be_float(s, s->mend));
}

glint_status glint_error_find_edges(glint_error_search *s, const glint_image *image,
                                    const glint_settings *settings, glint_error *error)
{
    if (s->grid.step == 1 || !glint_error_may_be_float(s, 0)) {
        return GLINT_OK;
    }
    glint_settings in_float = *settings;
    in_float.precision = GLINT_PRECISION_FLOAT;
    const glint_error_edges edges = {image, &in_float, MENDED_EDGES * s->asked->bound};
    glint_edge_errors found;
    TRY(glint_error_grid_find_edges(&s->grid, &edges, &found, error));
    // If paths end at their first surface, the error of rays is so small that it can be left out.
    const bool counts = s->glass || s->deepest > 1;
    s->unseen = hypot(s->unseen, counts ? found.at_most : 0);
    s->mended_unseen = hypot(s->mended_unseen, counts ? found.mended : 0);
    s->mend = found.mend;
    return GLINT_OK;
}

bool glint_error_wants_chaos(const glint_error_search *s, uint32_t deepest)
{
    return has_hope(s) && s->relative_contrast > 0 && deepest > CHAOS_DEPTH;
}

// The error if pixels show another direction, but none of the grid's pixels does.
static double none_seen(const glint_error_search *s)
{
    const double pixels = (double)glint_error_grid_pixel_count(&s->grid);
    return s->relative_contrast * sqrt(UNRELATED * NONE_SEEN / pixels);
}

glint_status glint_error_find_chaos(glint_error_search *s, const glint_image *image,
                                    uint32_t deepest, const glint_settings *settings,
                                    glint_error *error)
{
    if (!glint_error_wants_chaos(s, deepest)) {
        return GLINT_OK;
    }
    double unseen = none_seen(s);
    // If the estimate without measurement takes too much of the bound, measure.
    if (hypot(s->unseen, unseen) > AFFORDABLE * s->asked->bound) {
        const glint_error_chaos chaos = {image, settings, CHAOS_DEPTH, s->contrast};
        double share;
        TRY(glint_error_grid_find_chaos(&s->grid, &chaos, &share, error));
        unseen = fmin(unseen, CHAOS_FACTOR * s->relative_contrast * sqrt(share));
    }
    s->unseen = hypot(s->unseen, unseen);
    if (unseen > 0 && s->mend > 0) {
        s->mended_unseen = hypot(s->mended_unseen, MENDED_CHAOS * unseen);
        s->mend = fmin(s->mend, MENDED_CONTRAST * s->relative_contrast);
    }
    return GLINT_OK;
}
