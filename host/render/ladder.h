// The ladder: ways to render one scene, from the crudest to the reference, each with less of an
// error than most of those before and at a higher cost. Which of them there are depends on what the
// scene has: where nothing is glass there is no Fresnel term to leave out. Pure: calls no OpenCL.
#ifndef GLINT_RENDER_LADDER_H
#define GLINT_RENDER_LADDER_H

#include "render/plan.h"

#include <stddef.h>

#define GLINT_RUNGS_MAX 14

// Where the reference's paths end. Its depth is that of --depth auto and no more, as there is none
// at which nothing changes any more: light that glass reflects totally can stay in it for ever, of
// the gallery 10⁻⁵ of all weight at 16,384 surfaces still, and what it takes in the end is
// arbitrary. Below the weight next to nothing is left: with four times of it, gallery and nested
// glass differ by 2·10⁻⁴ and 6·10⁻⁴ (relative RMSE), other scenes not at all.
#define GLINT_REFERENCE_DEPTH GLINT_DEPTH_MAX
#define GLINT_REFERENCE_MIN_WEIGHT (1.0 / 65536)

typedef struct glint_rung {
    char name[64];     // "weights of 1/64"
    char options[128]; // the program's, that make it: "--min-weight 0.015625"
    glint_settings settings;
} glint_rung;

// A rung of these settings; where they ask for exact lobes its options end with that.
void glint_rung_of(const glint_settings *settings, const char *name, const char *options,
                   glint_rung *rung);
// Rungs that are the settings but for what their names say: how many surfaces paths meet (0: as
// many as the weight allows); below which weight branches are not followed; the reference, whose
// lobes are exact where surfaces are `rough`.
void glint_rung_by_depth(const glint_settings *settings, int depth, glint_rung *rung);
void glint_rung_by_weight(const glint_settings *settings, glint_precision precision,
                          glint_texels texels, double min_weight, glint_rung *rung);
// A rung in single precision, mended by so much, to three digits; 0: not at all.
void glint_rung_mend(double mend, glint_rung *rung);
void glint_rung_reference(const glint_settings *settings, bool rough, glint_rung *reference);

// Plain data.
typedef struct glint_ladder {
    size_t count;
    glint_rung rungs[GLINT_RUNGS_MAX]; // roughly in the order of what they cost, the cheapest first
    glint_rung reference;              // what their errors are counted from
} glint_ladder;

// `plan` is made of `settings`, in which model, depth, precision, texels and weights are at their
// defaults: what a rung does not say of them, and all else, is theirs.
void glint_ladder_make(const glint_plan *plan, const glint_settings *settings,
                       glint_ladder *ladder);

#endif
