// Makes the ladder of a scene: settings from the crudest to the reference. Each rung has a smaller
// error than most rungs before it, at a higher cost. The rungs depend on the scene: without glass
// there is no Fresnel term to leave out. Pure: calls no OpenCL.
#ifndef GLINT_RENDER_LADDER_H
#define GLINT_RENDER_LADDER_H

#include "render/plan.h"

#include <stddef.h>

#define GLINT_RUNGS_MAX 14

// The depth and the least weight at which the reference's paths end. The depth is that of --depth
// auto, because no depth exists beyond which nothing changes. Light that glass reflects totally can
// stay inside for ever: in the gallery, 10⁻⁵ of all weight still does at 16,384 surfaces. Its final
// value is arbitrary. Below the least weight almost nothing is left: with four times this weight,
// gallery and nested glass differ by 2·10⁻⁴ and 6·10⁻⁴ (relative RMSE), and other scenes not at
// all.
#define GLINT_REFERENCE_DEPTH GLINT_DEPTH_MAX
#define GLINT_REFERENCE_MIN_WEIGHT (1.0 / 65536)

typedef struct glint_rung {
    char name[64];     // "weights of 1/64"
    char options[128]; // the program's options: "--min-weight 0.015625"
    glint_settings settings;
} glint_rung;

// Makes a rung of these settings. If they ask for exact lobes, its options end with this option.
void glint_rung_of(const glint_settings *settings, const char *name, const char *options,
                   glint_rung *rung);
// Make rungs from the settings. by_depth limits the number of surfaces of a path (0: as many as the
// weight allows). by_weight stops at branches below the weight.
void glint_rung_by_depth(const glint_settings *settings, int depth, glint_rung *rung);
void glint_rung_by_weight(const glint_settings *settings, glint_precision precision,
                          glint_texels texels, double min_weight, glint_rung *rung);
// Adds mending with the limit `mend`, rounded to three digits, to a rung in single precision. 0: no
// mending.
void glint_rung_mend(double mend, glint_rung *rung);
// Makes the reference. Its lobes are exact if surfaces are `rough`.
void glint_rung_reference(const glint_settings *settings, bool rough, glint_rung *reference);

// Plain data.
typedef struct glint_ladder {
    size_t count;
    glint_rung rungs[GLINT_RUNGS_MAX]; // roughly in order of cost, the cheapest first
    glint_rung reference;              // the rung that errors are measured against
} glint_ladder;

// Makes the ladder. `plan` is the plan of `settings`, whose model, depth, precision, texels and
// weights are at their defaults. A rung takes from them all that it does not change.
void glint_ladder_make(const glint_plan *plan, const glint_settings *settings,
                       glint_ladder *ladder);

#endif
