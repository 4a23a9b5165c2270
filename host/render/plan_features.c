// Decides what is compiled into the kernels, with reasons. See plan_features.h.
#include "render/plan_features.h"

#include "base/memory.h"
#include "render/plan_device.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

// The feature that each lobe of a material needs, and how the reason describes such materials.
#define LOBES(LOBE)                                                                                \
    LOBE(MIRROR, metal, "a metallic share")                                                        \
    LOBE(TINT, tint, "coloured metal")                                                             \
    LOBE(GLASS, glass, "transmission")                                                             \
    LOBE(SOLID, solid, "a volume")                                                                 \
    LOBE(THIN_WALL, thin, "transmission and no volume")                                            \
    LOBE(ABSORPTION, absorption, "absorption inside")                                              \
    LOBE(DISPERSION, dispersion, "KHR_materials_dispersion")                                       \
    LOBE(PAINT, paint, "a share of paint")                                                         \
    LOBE(DIFFUSE_TRANSMISSION, translucent, "KHR_materials_diffuse_transmission")                  \
    LOBE(GLOSS, gloss, "paint of roughness 0, or textured")                                        \
    LOBE(SPECULAR, specular, "KHR_materials_specular")                                             \
    LOBE(CLEARCOAT, clearcoat, "KHR_materials_clearcoat")                                          \
    LOBE(IRIDESCENCE, iridescent, "KHR_materials_iridescence")                                     \
    LOBE(BLEND, blend, "the lecture's blend")                                                      \
    LOBE(UNLIT, unlit, "KHR_materials_unlit")                                                      \
    LOBE(EMISSION, emission, "emission")

typedef struct material_census {
    size_t used;                         // materials in use
    size_t needing[GLINT_FEATURE_COUNT]; // used materials with the lobe that needs the feature
    size_t metal_and_glass;              // materials that are metal and glass at once
    // Materials that alpha makes partly transparent; of these, those that also reflect.
    size_t partly_there, partly_reflects;
    // Clear coats that reflect in another direction than the layer below.
    size_t coats_apart;
    // Materials that reflect rough lobes; of these, those that are not metal.
    size_t rough, rough_coats;
    size_t faceted; // materials of rough glass
    size_t brushed; // materials with anisotropic roughness
    size_t sheen;   // materials with sheen
    // Least roughness of the rough materials; 0 if a texture sets it.
    double least_roughness;
} material_census;

static void note_roughness(const glint_material *material, float roughness, glint_texture_slot slot,
                           material_census *census)
{
    const double least = material->textures[slot].image != 0 ? 0 : (double)roughness;
    census->least_roughness = fmin(census->least_roughness, least);
}

static void count_roughness(const glint_material *material, const glint_lobes *lobes,
                            material_census *census)
{
    if (lobes->rough) {
        census->rough++;
        census->rough_coats += !lobes->metal;
        note_roughness(material, material->roughness, GLINT_TEXTURE_METALLIC_ROUGHNESS, census);
    }
    if (lobes->sheen) {
        census->rough++;
        census->sheen++;
        note_roughness(material, material->sheen_roughness, GLINT_TEXTURE_SHEEN_ROUGHNESS, census);
    }
    if (lobes->rough_clearcoat) {
        census->rough++;
        census->rough_coats++;
        note_roughness(material, material->clearcoat_roughness, GLINT_TEXTURE_CLEARCOAT_ROUGHNESS,
                       census);
    }
}

// True if the reflection of a clear coat may be a separate branch beside that of the layer below.
static bool is_coat_apart(const glint_material *material, const glint_lobes *lobes,
                          bool heeds_roughness)
{
    const bool below = lobes->metal || lobes->gloss || (lobes->rough_path && heeds_roughness);
    const bool lobe = heeds_roughness && (lobes->rough || lobes->sheen || lobes->rough_clearcoat);
    const bool bends = glint_material_normal_texture(material)->image != 0;
    return lobes->clearcoat && below && (lobe || bends);
}

static void count_material(const glint_material *material, bool heeds_roughness,
                           material_census *census)
{
    const glint_lobes lobes = glint_material_lobes(material);
    census->used++;
    census->metal_and_glass += lobes.metal && lobes.glass;
    census->partly_there += lobes.masked || lobes.covers;
    census->coats_apart += is_coat_apart(material, &lobes, heeds_roughness);
    census->partly_reflects +=
        lobes.covers && (lobes.metal || lobes.gloss || lobes.blend_mirror || lobes.glass ||
                         lobes.clearcoat || (lobes.rough_path && heeds_roughness));
    if (heeds_roughness) {
        census->faceted += lobes.facets;
        census->brushed += lobes.brushed;
        count_roughness(material, &lobes, census);
    }
#define COUNT(feature, lobe, what) census->needing[GLINT_FEATURE_##feature] += lobes.lobe;
    LOBES(COUNT)
#undef COUNT
}

static glint_status take_census(const glint_plan_inputs *in, material_census *census,
                                glint_error *error)
{
    const glint_scene *scene = in->scene;
    const bool heeds_roughness = glint_settings_heed_roughness(in->settings);
    *census = (material_census){.least_roughness = 1};
    bool *used = calloc(scene->material_count + 1, sizeof *used);
    if (used == NULL) {
        return glint_fail_memory(error, "the plan");
    }
    for (size_t i = 0; i < scene->instance_count; i++) {
        if (scene->instances[i].triangle_count > 0) {
            used[scene->instances[i].material] = true;
        }
    }
    for (size_t i = 0; i < scene->material_count; i++) {
        if (used[i]) {
            count_material(&scene->materials[i], heeds_roughness, census);
        }
    }
    free(used);
    return GLINT_OK;
}

static void decide(glint_plan *plan, glint_feature feature, bool compiled, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void decide(glint_plan *plan, glint_feature feature, bool compiled, const char *format, ...)
{
    glint_feature_choice *choice = &plan->features[feature];
    choice->compiled = compiled;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(choice->reason, sizeof choice->reason, format, arguments);
    va_end(arguments);
}

// "2 of 5 materials with transmission"
static void decide_by_count(glint_plan *plan, glint_feature feature, size_t count, size_t of,
                            const char *what)
{
    decide(plan, feature, count > 0, "%zu of %zu material%s with %s", count, of, of == 1 ? "" : "s",
           what);
}

static void decide_materials(const material_census *c, glint_plan *plan)
{
    decide(plan, GLINT_FEATURE_MANY_MATERIALS, c->used > 1, "%zu material%s in use", c->used,
           c->used == 1 ? "" : "s");
#define DECIDE(feature, lobe, what)                                                                \
    decide_by_count(plan, GLINT_FEATURE_##feature, c->needing[GLINT_FEATURE_##feature], c->used,   \
                    what);
    LOBES(DECIDE)
#undef DECIDE
}

// Decides FRESNEL, SPLIT and coats. Without Fresnel's equations, a path splits only at materials
// that are metal and glass at once.
static void decide_optics(const material_census *c, glint_fresnel fresnel, glint_plan *plan)
{
    const bool exact = fresnel == GLINT_FRESNEL_EXACT;
    const size_t glass = c->needing[GLINT_FEATURE_GLASS];
    const bool angular = c->needing[GLINT_FEATURE_TINT] > 0 || glass > 0 ||
                         c->needing[GLINT_FEATURE_GLOSS] > 0 || c->rough > 0 ||
                         c->needing[GLINT_FEATURE_CLEARCOAT] > 0 ||
                         c->needing[GLINT_FEATURE_IRIDESCENCE] > 0;
    decide(plan, GLINT_FEATURE_FRESNEL, exact && angular, "%s",
           !exact    ? "no Fresnel term was asked for"
           : angular ? "coloured metal, glass, coats, or what reflects lobes or is smooth paint"
                     : "no coloured metal, glass, coats, lobes or smooth paint");
    if (glass > 0 && exact) {
        decide_by_count(plan, GLINT_FEATURE_SPLIT, glass, c->used, "transmission and Fresnel");
    } else if (c->partly_reflects > 0) {
        decide_by_count(plan, GLINT_FEATURE_SPLIT, c->partly_reflects, c->used,
                        "alpha that reflect");
    } else if (c->coats_apart > 0 && exact && !glint_plan_shades_vertices(plan)) {
        decide_by_count(plan, GLINT_FEATURE_SPLIT, c->coats_apart, c->used,
                        "a clear coat over what reflects");
    } else {
        decide_by_count(plan, GLINT_FEATURE_SPLIT, c->metal_and_glass, c->used,
                        "both metal and transmission");
    }
    if (!exact) {
        decide(plan, GLINT_FEATURE_GLOSS, false, "no Fresnel term was asked for");
        decide(plan, GLINT_FEATURE_SPECULAR, false, "no Fresnel term was asked for");
        decide(plan, GLINT_FEATURE_CLEARCOAT, false, "no Fresnel term was asked for");
        decide(plan, GLINT_FEATURE_IRIDESCENCE, false, "no Fresnel term was asked for");
    } else if (glint_plan_shades_vertices(plan)) {
        decide(plan, GLINT_FEATURE_CLEARCOAT, false, "vertices are shaded, without coats");
    }
    if (exact && !angular && plan->features[GLINT_FEATURE_SPECULAR].compiled) {
        decide(plan, GLINT_FEATURE_SPECULAR, false, "these settings show paint without its coat");
    }
}

// At grazing angles, lobes are a few times narrower.
#define GRAZING_LEVELS 2

// Chooses the finest level of cells. Rough surfaces need cells as small as exact rendering of their
// narrowest lobe requires. So all settings see the same cells.
static void choose_cells(const material_census *c, glint_fresnel fresnel, glint_plan *plan)
{
    const size_t rough = fresnel == GLINT_FRESNEL_EXACT ? c->rough : c->rough - c->rough_coats;
    plan->cells_last = -1;
    if (rough > 0) {
        const double least = fmax(c->least_roughness, (double)GLINT_ROUGHNESS_NARROW);
        const double alpha = least * least;
        const double widest =
            (double)GLINT_LOBE_WIDEST * (1 + (double)GLINT_LOBE_TAIL / (alpha * alpha));
        const double width = fmin(alpha, sqrt(widest));
        // In the middle of the lobe, a cell contributes about ratio² of the light that the lobe
        // gathers.
        const double ratio = pow(2.5 * glint_lobe_tolerance(GLINT_ROUGHNESS_EXACT), 1.0 / 6);
        const double level = ceil(log2(2 / (ratio * width) / GLINT_CELLS_ROOT)) + GRAZING_LEVELS;
        plan->cells_last = (int)fmin(fmax(level, 0), GLINT_CELLS_LEVELS - 1);
    }
}

// Decides the attributes of vertices and textures. If vertices are shaded, only the materials'
// factors count.
static void decide_attributes(const glint_plan_inputs *in, glint_plan *plan)
{
    const glint_attributes *set = &in->scene->attribute_set;
    const bool by_vertex = glint_plan_shades_vertices(plan);
    const bool heeded = in->settings->output != GLINT_OUTPUT_HITS && !by_vertex;
    const struct {
        glint_feature feature;
        bool is_there;
        const char *what;
    } attributes[] = {
        {GLINT_FEATURE_TEXTURES, set->texcoords, "some material has textures"},
        {GLINT_FEATURE_SECOND_TEXCOORDS, set->second_texcoords, "some texture uses TEXCOORD_1"},
        {GLINT_FEATURE_NORMAL_MAPS, set->tangents, "some material needs tangents"},
        {GLINT_FEATURE_COLORED_VERTICES, set->colors, "some primitive has colours"},
    };
    for (size_t i = 0; i < sizeof attributes / sizeof *attributes; i++) {
        decide(plan, attributes[i].feature, heeded && attributes[i].is_there, "%s",
               !attributes[i].is_there ? "there are none"
               : heeded                ? attributes[i].what
               : by_vertex             ? "vertices are shaded, by the materials' factors alone"
                                       : "hits alone are wanted");
    }
    const int taps = in->settings->anisotropy;
    const bool textured = plan->features[GLINT_FEATURE_TEXTURES].compiled;
    decide(plan, GLINT_FEATURE_ANISOTROPY, textured && taps > 1, "anisotropy %d%s", taps,
           textured ? "" : ", and no textures");
}

// Counts the lights that shine; decide_lights finds whether a material shows them. Without such
// lights, decides LIGHTS with the reason.
static glint_status count_lights(const glint_plan_inputs *in, glint_plan *plan, glint_error *error)
{
    const glint_scene *scene = in->scene;
    const size_t count = scene->light_count;
    const char *why_not = count == 0                                  ? "the scene has no lights"
                          : in->settings->lights == GLINT_LIGHTS_NONE ? "lights none"
                          : in->settings->output == GLINT_OUTPUT_HITS ? "hits alone are wanted"
                          : glint_plan_shades_vertices(plan)
                              ? "vertices are shaded, by the environment alone"
                              : NULL;
    plan->light_count = why_not == NULL ? count : 0;
    if (why_not != NULL) {
        decide(plan, GLINT_FEATURE_LIGHTS, false, "%s", why_not);
    }
    return plan->light_count <= GLINT_PUNCTUAL_LIGHTS_MAX
               ? GLINT_OK
               : glint_fail(error, GLINT_BAD_INPUT,
                            "%s: %zu lights shine, %d at most can be rendered (leave some out, or "
                            "use --lights none)",
                            scene->path != NULL ? scene->path : "the scene", count,
                            GLINT_PUNCTUAL_LIGHTS_MAX);
}

static void decide_scene(const glint_plan_inputs *in, glint_plan *plan)
{
    const glint_scene *scene = in->scene;
    decide(plan, GLINT_FEATURE_GEOMETRY, scene->triangle_count > 0, "%zu triangles",
           scene->triangle_count);
    const bool by_vertex = glint_plan_shades_vertices(plan);
    const bool has_parts = scene->parts.count > 0;
    decide(plan, GLINT_FEATURE_LOCAL_ORIGINS, has_parts && !by_vertex, "%s",
           !has_parts  ? "nothing is small beside the scene"
           : by_vertex ? "light is found at vertices, where paths end at once"
                       : "some parts are small beside the scene");
    decide(plan, GLINT_FEATURE_SMOOTH_NORMALS, scene->normals != NULL || by_vertex, "%s",
           scene->normals != NULL ? "some primitive has normals"
           : by_vertex            ? "vertices are shaded, by their triangle's normal"
                                  : "no primitive has normals");
    if (!plan->features[GLINT_FEATURE_SOLID].compiled) {
        decide(plan, GLINT_FEATURE_NESTED_MEDIA, false, "no material with a volume");
    } else if (scene->moves) {
        decide(plan, GLINT_FEATURE_NESTED_MEDIA, true, "solids may come to nest: the scene moves");
    } else if (glint_topology_solids_may_nest(scene, in->topology)) {
        decide(plan, GLINT_FEATURE_NESTED_MEDIA, true,
               "solids may nest: not all are convex and apart from each other");
    } else {
        decide(plan, GLINT_FEATURE_NESTED_MEDIA, false,
               "every solid is convex and their bounds are apart: none nests");
    }
}

// Decides OVERLAPS: solids touch or overlap, or may do so later, or have priorities and nest. It
// also handles solids of several materials.
static void decide_overlaps(const glint_plan_inputs *in, bool heeded, glint_plan *plan)
{
    const glint_solids *solids = in->solids;
    const bool solid = solids != NULL && plan->features[GLINT_FEATURE_SOLID].compiled;
    const size_t contacts = solids != NULL ? solids->contact_count : 0;
    if (solids != NULL) {
        glint_solids_remark(in->scene, in->topology, solids, &plan->remarks);
    }
    if (!solid || !heeded) {
        decide(plan, GLINT_FEATURE_OVERLAPS, false, "%s",
               solid ? "these settings meet each solid by itself" : "no material with a volume");
    } else if (contacts > 0) {
        decide(plan, GLINT_FEATURE_OVERLAPS, true, "solids touch or overlap: %zu pair%s", contacts,
               contacts == 1 ? "" : "s");
    } else if (solids->touch_others) {
        decide(plan, GLINT_FEATURE_OVERLAPS, true, "other surfaces touch solids");
    } else if (solids->mixed_count > 0) {
        decide(plan, GLINT_FEATURE_OVERLAPS, true, "surfaces of several materials bound one solid");
    } else if (in->scene->moves && solids->component_count > 1) {
        decide(plan, GLINT_FEATURE_OVERLAPS, true, "solids may come to touch: the scene moves");
    } else {
        const bool ranked = plan->features[GLINT_FEATURE_NESTED_MEDIA].compiled &&
                            glint_solids_have_priorities(in->scene);
        decide(plan, GLINT_FEATURE_OVERLAPS, ranked, "%s",
               ranked ? "solids have priorities" : "no solid touches or overlaps another");
    }
    if (plan->features[GLINT_FEATURE_OVERLAPS].compiled) {
        decide(plan, GLINT_FEATURE_NESTED_MEDIA, true, "as solids may touch or overlap");
        decide(plan, GLINT_FEATURE_ALPHA, true, "where solids overlap one of them is not there");
    }
}

// Stores the boxes in which the eye may be inside a solid.
static void note_boxes(const glint_plan_inputs *in, glint_plan *plan)
{
    for (size_t i = 0;
         plan->features[GLINT_FEATURE_SOLID].compiled && i < in->topology->component_count; i++) {
        const glint_component *c = &in->topology->components[i];
        if (!glint_instance_is_solid(in->scene, &in->scene->instances[c->instance])) {
            continue;
        }
        const bool is_new = plan->box_count < GLINT_PLAN_BOXES;
        const int number = is_new ? plan->box_count++ : GLINT_PLAN_BOXES - 1;
        for (int k = 0; k < 3; k++) {
            float *low = &plan->boxes[number][0][k], *high = &plan->boxes[number][1][k];
            *low = is_new ? c->low[k] : fminf(*low, c->low[k]);
            *high = is_new ? c->high[k] : fmaxf(*high, c->high[k]);
        }
    }
}

void glint_plan_decide_inside(bool may_be_inside, glint_plan *plan)
{
    const bool heeded =
        plan->shading == GLINT_SHADING_PIXEL && !plan->features[GLINT_FEATURE_HITS].compiled;
    decide(plan, GLINT_FEATURE_INSIDE, may_be_inside && heeded, "%s",
           !may_be_inside ? "the eye is outside of all solids' bounds"
           : heeded       ? "the eye is inside some solid's bounds"
                          : "these settings meet each solid by itself");
}

static void decide_settings(const glint_settings *settings, glint_plan *plan)
{
    int samples = settings->samples_per_axis * settings->samples_per_axis;
    decide(plan, GLINT_FEATURE_SUPERSAMPLING, samples > 1, "%d sample%s a pixel", samples,
           samples == 1 ? "" : "s");
    decide(plan, GLINT_FEATURE_TRANSPARENT, settings->transparent, "background %s",
           settings->transparent ? "transparent" : "env");
    const char *shading = glint_shading_name(plan->shading);
    decide(plan, GLINT_FEATURE_VERTEX_COLOR, plan->shading == GLINT_SHADING_VERTEX_COLOR,
           "shading %s", shading);
    decide(plan, GLINT_FEATURE_VERTEX_DIRECTION, plan->shading == GLINT_SHADING_VERTEX_DIRECTION,
           "shading %s", shading);
    bool hits =
        settings->output == GLINT_OUTPUT_HITS && plan->features[GLINT_FEATURE_GEOMETRY].compiled;
    decide(plan, GLINT_FEATURE_HITS, hits, "%s", hits ? "hits were asked for" : "colour is wanted");
    bool mip = settings->filter == GLINT_FILTER_MIP && !hits;
    decide(plan, GLINT_FEATURE_MIP_LEVELS, mip, "filter %s", mip ? "mip" : "bilinear");
    bool is_lit = plan->features[GLINT_FEATURE_PAINT].compiled ||
                  plan->features[GLINT_FEATURE_BLEND].compiled;
    bool harmonics = settings->irradiance == GLINT_IRRADIANCE_SH && is_lit;
    decide(plan, GLINT_FEATURE_IRRADIANCE_HARMONICS, harmonics, "irradiance %s",
           harmonics ? "sh"
           : is_lit  ? "exact"
                     : "is not needed");
    decide(plan, GLINT_FEATURE_PROXY, settings->proxy && !hits, "%s",
           settings->proxy ? "the environment is as far away as its proxy"
                           : "the environment is infinitely far away");
    bool turned = fmod(settings->env_rotate, 360) != 0;
    decide(plan, GLINT_FEATURE_ENV_ROTATION, turned, "turned by %g degrees", settings->env_rotate);
}

glint_status glint_plan_decide_features(const glint_plan_inputs *in, glint_plan *plan,
                                        glint_error *error)
{
    material_census census = {.used = 1};
    if (in->settings->output != GLINT_OUTPUT_HITS) { // hits read no material
        TRY(take_census(in, &census, error));
    }
    decide_materials(&census, plan);
    if (glint_plan_shades_vertices(plan)) {
        census.partly_there = census.partly_reflects = 0; // at vertices, a surface is either
                                                          // present or not
    }
    decide_by_count(plan, GLINT_FEATURE_ALPHA, census.partly_there, census.used, "alpha");
    decide_optics(&census, in->settings->fresnel, plan);
    choose_cells(&census, in->settings->fresnel, plan);
    plan->has_facets = census.faceted > 0;
    plan->is_brushed = census.brushed > 0;
    plan->has_sheen = census.sheen > 0;
    plan->is_translucent = census.needing[GLINT_FEATURE_DIFFUSE_TRANSMISSION] > 0;
    plan->disperses = census.needing[GLINT_FEATURE_DISPERSION] > 0;
    decide_scene(in, plan);
    decide_overlaps(
        in, in->settings->output != GLINT_OUTPUT_HITS && !glint_plan_shades_vertices(plan), plan);
    note_boxes(in, plan);
    glint_plan_decide_inside(false, plan); // false until a camera is known
    decide_attributes(in, plan);
    decide_settings(in->settings, plan);
    return count_lights(in, plan, error);
}

// Decides the features that depend on the depth and on proofs about the scene.
void glint_plan_decide_paths(glint_plan *plan)
{
    const bool escapes = plan->sight.exits_escape;
    decide(plan, GLINT_FEATURE_CONVEX_SOLID, escapes, "%s",
           escapes ? "all that there is is one closed, convex solid"
                   : "not proved of this scene, with these settings");

    decide(plan, GLINT_FEATURE_INTERREFLECTION,
           plan->features[GLINT_FEATURE_GEOMETRY].compiled &&
               (plan->depth > 1 || plan->features[GLINT_FEATURE_ALPHA].compiled ||
                plan->features[GLINT_FEATURE_INSIDE].compiled),
           plan->depth_is_exact  ? "depth %d is exact here"
           : plan->depth_is_auto ? "depth auto, %d at most"
                                 : "depth %d",
           plan->depth);
}

// Decides the features for roughness.
static void decide_roughness(const glint_settings *settings, glint_plan *plan)
{
    const bool heeded = glint_settings_heed_roughness(settings) && settings->terms == 0;
    const bool rough = plan->cells_last >= 0 && heeded;
    const bool brushed = plan->is_brushed && rough;
    decide(plan, GLINT_FEATURE_BRUSHED,
           brushed && plan->features[GLINT_FEATURE_NORMAL_MAPS].compiled, "%s",
           brushed ? "KHR_materials_anisotropy" : "no rough surface with KHR_materials_anisotropy");
    const bool sheen = plan->has_sheen && rough;
    decide(plan, GLINT_FEATURE_SHEEN, sheen, "%s",
           sheen              ? "KHR_materials_sheen"
           : !plan->has_sheen ? "no metal or paint with KHR_materials_sheen"
                              : "these settings show no sheen");
    const bool facets = plan->has_facets && heeded;
    decide(plan, GLINT_FEATURE_ROUGH, rough, "%s",
           rough    ? "rough metal, paint, clear coats or sheen"
           : heeded ? "no rough metal, paint or clear coats"
                    : "these settings show all as smooth");
    if (facets) {
        decide(plan, GLINT_FEATURE_FACETS, true, "rough glass: %d directions a pixel",
               glint_settings_directions(settings));
    } else {
        decide(plan, GLINT_FEATURE_FACETS, false, "%s",
               heeded ? "no rough glass" : "these settings show all as smooth");
    }
}

// Decides the feature for lights, if any shine: paint and lobes show them.
static void decide_lights(glint_plan *plan)
{
    const size_t count = plan->light_count;
    const bool shown = plan->features[GLINT_FEATURE_PAINT].compiled ||
                       plan->features[GLINT_FEATURE_BLEND].compiled ||
                       plan->features[GLINT_FEATURE_ROUGH].compiled;
    if (count > 0 && shown) {
        decide(plan, GLINT_FEATURE_LIGHTS, true, "%zu light%s", count, count == 1 ? "" : "s");
    } else if (count > 0) {
        decide(plan, GLINT_FEATURE_LIGHTS, false, "no material shows lights");
    }
}

// Decides the feature for paint that is lit from behind, if there is any.
static void decide_translucence(const glint_settings *settings, glint_plan *plan)
{
    const bool heeded = settings->terms == 0 && !glint_plan_shades_vertices(plan);
    if (plan->is_translucent) {
        decide(plan, GLINT_FEATURE_DIFFUSE_TRANSMISSION, heeded, "%s",
               heeded ? "KHR_materials_diffuse_transmission"
                      : "these settings light paint from the front alone");
    }
}

// Decides the feature for solids that disperse light, if there are any.
static void decide_dispersion(const glint_settings *settings, glint_plan *plan)
{
    if (!plan->disperses) {
        return;
    }
    if (glint_settings_heed_dispersion(settings)) {
        decide(plan, GLINT_FEATURE_DISPERSION, true, "%d wavelengths", settings->wavelengths);
    } else {
        decide(plan, GLINT_FEATURE_DISPERSION, false, "these settings show no dispersion");
    }
}

// Decides the features for effects and extra outputs.
void glint_plan_decide_extras(const glint_settings *settings, glint_plan *plan)
{
    decide_roughness(settings, plan);
    decide_lights(plan);
    decide_translucence(settings, plan);
    decide_dispersion(settings, plan);
    if (settings->terms > 0) {
        decide(plan, GLINT_FEATURE_TERMS, true, "%d directions of a pixel are kept",
               settings->terms);
    } else {
        decide(plan, GLINT_FEATURE_TERMS, false, "no directions were asked for");
    }
    decide(plan, GLINT_FEATURE_PIXEL_LIST, settings->list != NULL, "%s",
           settings->list != NULL ? "a list was given" : "all pixels, or a grid of them");
    decide(plan, GLINT_FEATURE_TRUNCATION_SQUARES, settings->truncation_squares, "%s",
           settings->truncation_squares ? "errors are to be bounded" : "no error is to be bounded");
    decide(plan, GLINT_FEATURE_DIAGNOSTICS, settings->aovs != 0, "%s",
           settings->aovs != 0 ? "layers were asked for" : "no layers were asked for");
}

void glint_plan_compile_idle_features(glint_plan *plan)
{
    enum { IDLE, SWITCHED, ACTIVE };
    static const bool is_idle[] = {
#define IS_IDLE(name, meaning, needs, excludes, unneeded, general) (unneeded) == IDLE,
        GLINT_FEATURES(IS_IDLE)
#undef IS_IDLE
    };
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        if (is_idle[i] && !plan->features[i].compiled &&
            plan->features[GLINT_FEATURE_GEOMETRY].compiled) {
            decide(plan, (glint_feature)i, true, "not needed, but all features were asked for");
        }
    }
}
