// What single precision makes of a frame's pixels here and there. See error_unseen.h.
//
//  - At edges and folds of glass, and where mirrors show each other, it shows the other side in a
//    pixel here and there, which may be off by ten times the mean. How many there may be, and of
//    what size, follows from the jumps between the grid's pixels and places beside them
//    (error_grid.h).
//  - Where light bounces so often between curved surfaces that it has no digits left, one pixel in
//    ten thousand is off by many times the mean. How likely that is of the grid's pixels is found
//    in double precision, and those are taken to show what another direction of the environment
//    would.
// Both are where the picture jumps, and what stands beside a jump can be mended (render/mend.h).
#include "bound/error_unseen.h"

#include <math.h>

// Surfaces after which single precision may have no digits left: light that glass focuses as it
// passes loses a digit at each or at every other one.
#define CHAOS_DEPTH 12
// By 1 what follows of it is 0.65 to 5 times what single precision errs by, of 12 views of three
// scenes of curved glass (built-in glass and mixed, gallery), and more of others.
#define CHAOS_FACTOR 2
// Of events of which none was seen there may be so many, with a confidence of 97.5%: an upper bound
// of a Poisson distribution's mean. With it need not be found how likely they are, where they may
// take this share of the bound.
#define NONE_SEEN 3.7
#define AFFORDABLE 0.5
// The mean square of how far two directions' light is apart, in squares of the contrast.
#define UNRELATED 2
// Of the bound, what edges may leave in a mended frame.
#define MENDED_EDGES 0.5
// Of what chaos makes of a frame, what is left where jumps are mended of this share of the
// contrast. Of 12 frames of the gallery, whose contrast is 5 times the mean, it is 0.37 where jumps
// of the mean are, and 0.10 of 0.3 of it.
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
    // Where paths end at their first surface, rays are off by so little that it may be left out.
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

// How much light that shows another direction may add, when none of the grid's pixels does.
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
