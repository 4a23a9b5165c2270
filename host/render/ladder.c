// Makes the rungs of the ladder. See ladder.h.
#include "render/ladder.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void glint_rung_of(const glint_settings *settings, const char *name, const char *options,
                   glint_rung *rung)
{
    const bool is_exact = settings->roughness == GLINT_ROUGHNESS_EXACT;
    rung->settings = *settings;
    snprintf(rung->name, sizeof rung->name, "%s", name);
    snprintf(rung->options, sizeof rung->options, "%s%s%s", options,
             is_exact && options[0] != '\0' ? " " : "", is_exact ? "--roughness exact" : "");
}

// Adds a rung with these settings, which the caller then changes.
static glint_rung *add(glint_ladder *ladder, const glint_settings *settings, const char *name,
                       const char *options)
{
    glint_rung *rung = &ladder->rungs[ladder->count++];
    glint_rung_of(settings, name, options, rung);
    return rung;
}

static bool has(const glint_plan *plan, glint_feature feature)
{
    return plan->features[feature].compiled;
}

// True if a path can meet a second surface.
static bool goes_on(const glint_plan *plan)
{
    return has(plan, GLINT_FEATURE_MIRROR) || has(plan, GLINT_FEATURE_GLASS) ||
           has(plan, GLINT_FEATURE_GLOSS) || has(plan, GLINT_FEATURE_BLEND) ||
           has(plan, GLINT_FEATURE_CLEARCOAT) || has(plan, GLINT_FEATURE_ROUGH);
}

// Adds shading at vertices, but not for scenes with lights: vertices do not show lights.
static void add_vertices(const glint_plan *plan, const glint_settings *settings,
                         glint_ladder *ladder)
{
    if (has(plan, GLINT_FEATURE_LIGHTS)) {
        return;
    }
    add(ladder, settings, "colours at vertices", "--shading vertex-color")->settings.shading =
        GLINT_SHADING_VERTEX_COLOR;
    add(ladder, settings, "directions at vertices", "--shading vertex-direction")
        ->settings.shading = GLINT_SHADING_VERTEX_DIRECTION;
}

void glint_rung_by_depth(const glint_settings *settings, int depth, glint_rung *rung)
{
    char name[32], options[32];
    snprintf(name, sizeof name, depth > 0 ? "depth %d" : "depth auto", depth);
    snprintf(options, sizeof options, depth > 0 ? "--depth %d" : "--depth auto", depth);
    glint_rung_of(settings, name, options, rung);
    rung->settings.depth = depth;
}

void glint_rung_by_weight(const glint_settings *settings, glint_precision precision,
                          glint_texels texels, double min_weight, glint_rung *rung)
{
    const bool is_double = precision == GLINT_PRECISION_DOUBLE;
    const bool is_float = !is_double && texels == GLINT_TEXELS_FLOAT;
    char name[64], options[64];
    snprintf(name, sizeof name, "weights of 1/%.0f%s", 1 / min_weight,
             is_double  ? ", double precision"
             : is_float ? ", float texels"
                        : "");
    snprintf(options, sizeof options, "--min-weight %.12g%s", min_weight,
             is_double  ? " --precision double"
             : is_float ? " --texels float"
                        : "");
    glint_rung_of(settings, name, options, rung);
    rung->settings.precision = precision;
    rung->settings.texels = texels;
    rung->settings.min_weight = min_weight;
}

void glint_rung_mend(double mend, glint_rung *rung)
{
    if (!(mend > 0)) {
        return;
    }
    char text[32]; // rounded, so that the options make the same picture
    snprintf(text, sizeof text, "%.3g", mend);
    rung->settings.mend = strtod(text, NULL);
    const size_t name = strlen(rung->name), options = strlen(rung->options);
    snprintf(rung->name + name, sizeof rung->name - name, ", mended");
    snprintf(rung->options + options, sizeof rung->options - options, "%s--mend %s",
             options > 0 ? " " : "", text);
}

static void add_depth(const glint_settings *settings, int depth, glint_ladder *ladder)
{
    glint_rung_by_depth(settings, depth, &ladder->rungs[ladder->count++]);
}

static void add_weights(const glint_settings *settings, glint_precision precision,
                        glint_texels texels, int inverse, glint_ladder *ladder)
{
    glint_rung_by_weight(settings, precision, texels, 1.0 / inverse,
                         &ladder->rungs[ladder->count++]);
}

// Adds rungs for scenes whose paths split. The least weight decides cost and error there; the depth
// has little effect. A path that the depth truncates may be as bright as any other, a light branch
// is not.
static void add_branching(const glint_settings *settings, glint_ladder *ladder)
{
    add(ladder, settings, "no Fresnel term", "--fresnel none")->settings.fresnel =
        GLINT_FRESNEL_NONE;
    for (int inverse = 16; inverse <= 1024; inverse *= 4) {
        add_weights(settings, GLINT_PRECISION_FLOAT, GLINT_TEXELS_AUTO, inverse, ladder);
    }
    add_weights(settings, GLINT_PRECISION_FLOAT, GLINT_TEXELS_FLOAT, 4096, ladder);
    for (int inverse = 1024; inverse <= 16384; inverse *= 4) {
        add_weights(settings, GLINT_PRECISION_DOUBLE, GLINT_TEXELS_AUTO, inverse, ladder);
    }
}

// Adds depths. Adds none if it is proved that a path meets only one surface.
static void add_bouncing(const glint_plan *plan, const glint_settings *settings,
                         glint_ladder *ladder)
{
    for (int depth = 2; depth <= 8 && depth < plan->depth; depth *= 2) {
        add_depth(settings, depth, ladder);
    }
    if (plan->depth > 1) {
        add_depth(settings, 0, ladder);
    }
}

static void add_exact(const glint_plan *plan, const glint_settings *settings, glint_ladder *ladder)
{
    if (plan->half_texels) {
        add(ladder, settings, "float texels", "--texels float")->settings.texels =
            GLINT_TEXELS_FLOAT;
    }
    add(ladder, settings, "double precision", "--precision double")->settings.precision =
        GLINT_PRECISION_DOUBLE;
}

void glint_rung_reference(const glint_settings *settings, bool rough, glint_rung *reference)
{
    glint_settings best = *settings;
    best.precision = GLINT_PRECISION_DOUBLE;
    best.depth = GLINT_REFERENCE_DEPTH;
    best.min_weight = GLINT_REFERENCE_MIN_WEIGHT;
    best.roughness = rough ? GLINT_ROUGHNESS_EXACT : best.roughness;
    char options[96];
    snprintf(options, sizeof options, "--precision double --depth %d --min-weight %.12g",
             GLINT_REFERENCE_DEPTH, GLINT_REFERENCE_MIN_WEIGHT);
    glint_rung_of(&best, "the reference", options, reference);
}

static void add_lobes(const glint_settings *settings, glint_ladder *ladder)
{
    glint_settings smooth = *settings, exact = *settings;
    smooth.roughness = GLINT_ROUGHNESS_SMOOTH;
    exact.roughness = GLINT_ROUGHNESS_EXACT;
    add(ladder, &smooth, "rough surfaces smooth", "--roughness smooth");
    add(ladder, &exact, "exact lobes", "");
}

void glint_ladder_make(const glint_plan *plan, const glint_settings *settings, glint_ladder *ladder)
{
    *ladder = (glint_ladder){0};
    const bool rough = has(plan, GLINT_FEATURE_ROUGH);
    glint_rung_reference(settings, rough, &ladder->reference);
    if (!has(plan, GLINT_FEATURE_GEOMETRY)) {
        add_exact(plan, settings, ladder);
        return;
    }
    add_vertices(plan, settings, ladder);
    add_depth(settings, 1, ladder);
    if (rough) {
        add_lobes(settings, ladder);
    }
    if (has(plan, GLINT_FEATURE_SPLIT)) {
        add_branching(settings, ladder);
        return;
    }
    if (goes_on(plan)) {
        add_bouncing(plan, settings, ladder);
    }
    if (has(plan, GLINT_FEATURE_PAINT) || has(plan, GLINT_FEATURE_BLEND)) {
        add(ladder, settings, "spherical harmonics", "--irradiance sh")->settings.irradiance =
            GLINT_IRRADIANCE_SH;
    }
    add_exact(plan, settings, ladder);
}
