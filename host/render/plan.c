// The plan: what is compiled, and why. See plan.h.
#include "render/plan.h"

#include "base/half.h"
#include "environment/mip_levels.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *glint_feature_name(glint_feature feature)
{
    static const char *const names[] = {
#define NAME(name, meaning) #name,
        GLINT_FEATURES(NAME)
#undef NAME
    };
    return names[feature];
}

const char *glint_feature_meaning(glint_feature feature)
{
    static const char *const meanings[] = {
#define MEANING(name, meaning) meaning,
        GLINT_FEATURES(MEANING)
#undef MEANING
    };
    return meanings[feature];
}

// The feature that each lobe of a material needs, and what the reason says of such materials.
#define LOBES(LOBE)                                                                                \
    LOBE(MIRROR, metal, "a metallic share")                                                        \
    LOBE(TINT, tint, "coloured metal")                                                             \
    LOBE(GLASS, glass, "transmission")                                                             \
    LOBE(SOLID, solid, "a volume")                                                                 \
    LOBE(THIN_WALL, thin, "transmission and no volume")                                            \
    LOBE(ABSORPTION, absorption, "absorption inside")                                              \
    LOBE(PAINT, paint, "a share of paint")                                                         \
    LOBE(GLOSS, gloss, "paint of roughness 0")                                                     \
    LOBE(BLEND, blend, "the lecture's blend")                                                      \
    LOBE(UNLIT, unlit, "KHR_materials_unlit")                                                      \
    LOBE(EMISSION, emission, "emission")

typedef struct material_census {
    size_t used;                         // materials in use
    size_t needing[GLINT_FEATURE_COUNT]; // of these, for a lobe
    size_t metal_and_glass;              // both at once
} material_census;

static void count_material(const glint_material *material, material_census *census)
{
    const glint_lobes lobes = glint_material_lobes(material);
    census->used++;
    census->metal_and_glass += lobes.metal && lobes.glass;
#define COUNT(feature, lobe, what) census->needing[GLINT_FEATURE_##feature] += lobes.lobe;
    LOBES(COUNT)
#undef COUNT
}

static glint_status take_census(const glint_scene *scene, material_census *census,
                                glint_error *error)
{
    *census = (material_census){0};
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
            count_material(&scene->materials[i], census);
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

// Without Fresnel's equations a path splits only where a material is metal and glass at once.
static void decide_optics(const material_census *c, glint_fresnel fresnel, glint_plan *plan)
{
    const bool exact = fresnel == GLINT_FRESNEL_EXACT;
    const size_t glass = c->needing[GLINT_FEATURE_GLASS];
    const bool angular =
        c->needing[GLINT_FEATURE_TINT] > 0 || glass > 0 || c->needing[GLINT_FEATURE_GLOSS] > 0;
    decide(plan, GLINT_FEATURE_FRESNEL, exact && angular, "%s",
           !exact    ? "no Fresnel term was asked for"
           : angular ? "coloured metal, glass or smooth paint"
                     : "no coloured metal, glass or smooth paint");
    if (glass > 0 && exact) {
        decide_by_count(plan, GLINT_FEATURE_SPLIT, glass, c->used, "transmission and Fresnel");
    } else {
        decide_by_count(plan, GLINT_FEATURE_SPLIT, c->metal_and_glass, c->used,
                        "both metal and transmission");
    }
    if (!exact) {
        decide(plan, GLINT_FEATURE_GLOSS, false, "no Fresnel term was asked for");
    }
}

static void decide_scene(const glint_plan_inputs *in, glint_plan *plan)
{
    const glint_scene *scene = in->scene;
    decide(plan, GLINT_FEATURE_GEOMETRY, scene->triangle_count > 0, "%zu triangles",
           scene->triangle_count);
    const bool by_vertex = glint_plan_shades_vertices(plan);
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

// From the depth, and from what is proved of the scene.
static void decide_paths(glint_plan *plan)
{
    const bool escapes = plan->sight.exits_escape;
    decide(plan, GLINT_FEATURE_CONVEX_SOLID, escapes, "%s",
           escapes ? "all that there is is one closed, convex solid"
                   : "not proved of this scene, with these settings");

    decide(plan, GLINT_FEATURE_INTERREFLECTION,
           plan->features[GLINT_FEATURE_GEOMETRY].compiled && plan->depth > 1,
           plan->depth_is_exact  ? "depth %d is exact here"
           : plan->depth_is_auto ? "depth auto, %d at most"
                                 : "depth %d",
           plan->depth);
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

// What is told of a frame beside its colours.
static void decide_extras(const glint_settings *settings, glint_plan *plan)
{
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

// A packet fills the widest vector of the device; where a work-item is one lane of the hardware's
// own (GPUs), a packet is one ray.
int glint_plan_native_width(const glint_capabilities *device, glint_precision precision)
{
    const int per_lane = precision == GLINT_PRECISION_DOUBLE ? 2 : 1;
    return !device->is_cpu ? 1 : device->native_float_width / per_lane >= 16 ? 16 : 8;
}

static void choose_width(const glint_plan_inputs *in, glint_plan *plan)
{
    const glint_capabilities *device = in->device;
    const bool is_double = plan->precision == GLINT_PRECISION_DOUBLE;
    const int lanes = device->native_float_width / (is_double ? 2 : 1);
    plan->bvh_width = device->native_float_width >= 16 ? 16 : 8;
    if (in->settings->kernel_width != 0) {
        plan->kernel_width = in->settings->kernel_width;
        snprintf(plan->width_reason, sizeof plan->width_reason, "asked for");
    } else if (!device->is_cpu) {
        plan->kernel_width = glint_plan_native_width(device, plan->precision);
        snprintf(plan->width_reason, sizeof plan->width_reason, "not a CPU: one ray a work-item");
    } else {
        plan->kernel_width = glint_plan_native_width(device, plan->precision);
        snprintf(plan->width_reason, sizeof plan->width_reason,
                 "%sthe device's vectors hold %d %ss", lanes < 8 ? "the narrowest packet; " : "",
                 lanes, is_double ? "double" : "float");
    }
}

// Neighbouring primary rays meet mostly the same nodes and triangles, so a core does well to trace
// many at once; a GPU needs its work in many small pieces.
static void choose_tiles(const glint_settings *settings, glint_plan *plan)
{
    plan->tiles = plan->kernel_width > 1 && settings->list == NULL;
    const char *reason = plan->tiles              ? "primary rays share nodes and triangles"
                         : settings->list != NULL ? "pixels of a list need not be neighbours"
                                                  : "one ray a work-item";
    if (settings->tile_packets != 0 && settings->list == NULL) {
        plan->tiles = settings->tile_packets > 1;
        reason = "asked for";
    }
    snprintf(plan->tiles_reason, sizeof plan->tiles_reason, "%s", reason);
}

// Says what kernels/traverse_together.cl makes of width and tiles.
static void describe_secondary_rays(glint_plan *plan)
{
    const bool packets = plan->kernel_width > 1;
    snprintf(plan->secondary, sizeof plan->secondary, "%s%s%s", packets ? "packets" : "one by one",
             plan->tiles ? ", together where a tile's run alike" : "",
             packets ? ", in a stream where they spread" : "");
    if (!plan->features[GLINT_FEATURE_INTERREFLECTION].compiled) {
        snprintf(plan->secondary, sizeof plan->secondary, "none");
    }
}

// What rounding may add to what is seen of the environment (visible_rmse). Where all is as bright
// as the mean it comes to 2.1e-4; more means that texels are too dark for half and lose digits.
#define TEXEL_TOLERANCE 2.5e-4

// Half, if the environment can be held and, unless half was asked for, is held well.
static glint_status weigh_half_texels(const glint_plan_inputs *in, glint_plan *plan,
                                      glint_error *error)
{
    const bool asked_for = in->settings->texels == GLINT_TEXELS_HALF;
    const size_t capacity = sizeof plan->texels_reason;
    glint_half_rounding half;
    if (in->half != NULL) {
        half = *in->half;
    } else {
        glint_status status = glint_half_rounding_measure(in->environment, &half, error);
        if (status != GLINT_OK) {
            return status;
        }
    }
    double largest = (double)half.largest, most = (double)GLINT_HALF_MAX;
    bool fits = largest <= most; // NaN does not
    if (!fits && asked_for) {
        return glint_fail(error, GLINT_USAGE,
                          "--texels half: the environment's brightest texel is %g, and half holds "
                          "%g at most (use --texels float)",
                          largest, most);
    }
    if (!fits) {
        snprintf(plan->texels_reason, capacity, "the brightest, %g, is more than half holds (%g)",
                 largest, most);
        return GLINT_OK;
    }
    plan->half_texels = asked_for || half.visible_rmse <= TEXEL_TOLERANCE;
    snprintf(plan->texels_reason, capacity, "%s an error of %.2g of what is seen (%.2g is allowed)",
             asked_for           ? "asked for; rounding adds"
             : plan->half_texels ? "rounding adds"
                                 : "rounding to half would add",
             half.visible_rmse, TEXEL_TOLERANCE);
    if (plan->half_texels) {
        plan->texels_rmse = half.relative_rmse;
        plan->environment_bytes /= 2;
    }
    return GLINT_OK;
}

// Half texels take half of the memory's time. Double precision, the reference, has them only if
// they are asked for.
glint_status glint_plan_choose_texels(const glint_plan_inputs *in, glint_plan *plan,
                                      glint_error *error)
{
    const glint_texels asked = in->settings->texels;
    const char *reason = NULL;
    plan->half_texels = false;
    plan->texels_rmse = 0;
    plan->environment_bytes = sizeof(float) * (plan->features[GLINT_FEATURE_MIP_LEVELS].compiled
                                                   ? glint_mip_levels_size(in->environment->edge)
                                                   : glint_cube_size(in->environment));
    if (asked == GLINT_TEXELS_FLOAT) {
        reason = "asked for";
    } else if (asked == GLINT_TEXELS_AUTO && plan->precision == GLINT_PRECISION_DOUBLE) {
        reason = "precision double is the reference";
    }
    if (reason == NULL) {
        return weigh_half_texels(in, plan, error);
    }
    snprintf(plan->texels_reason, sizeof plan->texels_reason, "%s", reason);
    return GLINT_OK;
}

// What does not fill a stack of waiting branches costs nothing, so that all weights down to 2^−16
// share a kernel.
#define STACK_LEAST 18

// The path goes on with the lighter of two branches, which has at most half of the weight, so that
// at most 1 + log2(1/min_weight) wait; one more slot tells that the stack is nearly full.
static void choose_stack(const glint_settings *settings, glint_plan *plan)
{
    plan->stack_capacity = 0;
    if (!plan->features[GLINT_FEATURE_SPLIT].compiled) {
        snprintf(plan->stack_reason, sizeof plan->stack_reason, "no path splits");
        return;
    }
    double by_weight = settings->min_weight > 0 ? floor(-log2(settings->min_weight)) + 1 : INFINITY;
    double need = fmin(by_weight, plan->depth) + 1;
    plan->stack_capacity = (int)fmax(STACK_LEAST, fmin(need, GLINT_DEPTH_MAX + 1));
    if (need > plan->stack_capacity) {
        snprintf(plan->stack_reason, sizeof plan->stack_reason,
                 "%d is the most; more would be truncated and reported", plan->stack_capacity);
    } else {
        snprintf(plan->stack_reason, sizeof plan->stack_reason,
                 "enough for every path of depth %d and least weight %g", plan->depth,
                 settings->min_weight);
    }
}

// What the waiting branches of a tile may take of a work-item's own memory, which on CPUs is a
// thread's stack: the C library's least default is 2 MiB.
#define BRANCHES_MAX_BYTES ((size_t)5 << 18)

// A tile's pixels each have room for as many branches as one path may need; where that comes to too
// much a work-item renders one packet.
static void limit_branches(glint_plan *plan)
{
    // The struct branch of kernels/branches.cl, at most.
    const size_t branch = plan->precision == GLINT_PRECISION_DOUBLE ? 120 : 64;
    const size_t bytes = branch * 16 * (size_t)plan->kernel_width * (size_t)plan->stack_capacity;
    if (plan->tiles && bytes > BRANCHES_MAX_BYTES) {
        plan->tiles = false;
        snprintf(plan->tiles_reason, sizeof plan->tiles_reason,
                 "the waiting branches of a tile would take %zu KiB", bytes >> 10);
    }
}

// Entries of the fewest bits that can name every medium; without nesting one entry is enough.
static void choose_media(const glint_scene *scene, glint_plan *plan)
{
    int media = 0;
    for (size_t i = 0; i < scene->material_count; i++) {
        media += glint_material_lobes(&scene->materials[i]).solid;
    }
    plan->media_count = media;
    int bits = 1;
    while (bits < 30 && (1 << bits) <= media) {
        bits++;
    }
    plan->media_bits = bits;
    bool nested = plan->features[GLINT_FEATURE_NESTED_MEDIA].compiled;
    plan->media_capacity = nested ? 30 / bits : 1;
}

// To show that unneeded features change nothing. Those that contradict the settings (a transparent
// background) would change the picture and stay as they are; so do normals that the scene does not
// have and layers that were not asked for, whose buffers are stand-ins.
static void compile_everything(glint_plan *plan)
{
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        bool stays = i == GLINT_FEATURE_TRANSPARENT || i == GLINT_FEATURE_FRESNEL ||
                     i == GLINT_FEATURE_HITS || i == GLINT_FEATURE_PROXY ||
                     i == GLINT_FEATURE_PIXEL_LIST || i == GLINT_FEATURE_MIP_LEVELS ||
                     i == GLINT_FEATURE_IRRADIANCE_HARMONICS || i == GLINT_FEATURE_SMOOTH_NORMALS ||
                     i == GLINT_FEATURE_DIAGNOSTICS || i == GLINT_FEATURE_TERMS ||
                     i == GLINT_FEATURE_VERTEX_COLOR || i == GLINT_FEATURE_VERTEX_DIRECTION ||
                     i == GLINT_FEATURE_CONVEX_SOLID ||
                     (i == GLINT_FEATURE_INTERREFLECTION && plan->depth == 1);
        if (stays || plan->features[i].compiled ||
            !plan->features[GLINT_FEATURE_GEOMETRY].compiled) {
            continue;
        }
        decide(plan, (glint_feature)i, true, "not needed, but all features were asked for");
    }
}

// Layers tell what was cut short, which a depth that is proved would be told of as.
static void choose_sight(const glint_settings *settings, const glint_sight *sight, glint_plan *plan)
{
    plan->sight = (glint_sight){0};
    if (sight != NULL && glint_plan_may_heed_sight(settings)) {
        plan->sight =
            settings->aovs == 0 ? *sight : (glint_sight){.exits_escape = sight->exits_escape};
    }
}

static void choose_depth(const glint_settings *settings, const glint_sight *sight, glint_plan *plan)
{
    plan->depth_is_auto = settings->depth == 0;
    plan->depth = plan->depth_is_auto ? GLINT_DEPTH_MAX : settings->depth;
    if (settings->output == GLINT_OUTPUT_HITS) {
        plan->depth = 1;
    } else if (glint_plan_shades_vertices(plan)) {
        plan->depth = 1;
        plan->depth_is_auto = false;
    }
    choose_sight(settings, sight, plan);
    plan->depth_is_exact = plan->sight.depth > 0;
    if (plan->depth_is_exact) {
        plan->depth = plan->sight.depth;
    }
}

void glint_plan_heed_sight(glint_plan *plan, bool heed)
{
    if (plan->sight.depth == 0 || plan->depth_is_exact == heed) {
        return;
    }
    plan->depth_is_exact = heed;
    plan->depth = heed ? plan->sight.depth : GLINT_DEPTH_MAX;
    decide_paths(plan);
    describe_secondary_rays(plan);
}

// The part of a plan that rests on neither scene nor topology.
static glint_status vary(const glint_plan_inputs *in, glint_plan *plan, glint_error *error)
{
    const glint_settings *settings = in->settings;
    plan->precision = settings->precision;
    choose_depth(settings, in->sight, plan);
    decide_paths(plan);
    decide_extras(settings, plan);
    if (settings->all_features) {
        compile_everything(plan);
    }
    choose_width(in, plan);
    choose_tiles(settings, plan);
    choose_stack(settings, plan);
    limit_branches(plan);
    describe_secondary_rays(plan);
    return glint_plan_choose_texels(in, plan, error);
}

glint_status glint_plan_make(const glint_plan_inputs *in, glint_plan *plan, glint_error *error)
{
    *plan = (glint_plan){0};
    const glint_settings *settings = in->settings;
    glint_status status = glint_settings_check(in->settings, in->device, in->scene, error);
    if (status != GLINT_OK) {
        return status;
    }
    material_census census;
    status = take_census(in->scene, &census, error);
    if (status != GLINT_OK) {
        return status;
    }
    plan->build_tag = settings->build_tag;
    if (settings->output == GLINT_OUTPUT_HITS) {
        census = (material_census){.used = 1}; // whatever they are, none is looked at
    } else if (in->scene->triangle_count > 0) {
        plan->shading = settings->shading;
    }
    decide_materials(&census, plan);
    decide_optics(&census, settings->fresnel, plan);
    decide_scene(in, plan);
    decide_settings(settings, plan);
    if (settings->all_features) {
        compile_everything(plan); // media as well
    }
    choose_media(in->scene, plan);
    plan->traversal_stack = 64;
    return vary(in, plan, error);
}

glint_status glint_plan_vary(const glint_plan_inputs *in, glint_plan *plan, glint_error *error)
{
    glint_status status = glint_settings_check(in->settings, in->device, in->scene, error);
    return status == GLINT_OK ? vary(in, plan, error) : status;
}

int glint_plan_feature_count(const glint_plan *plan)
{
    int count = 0;
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        count += plan->features[i].compiled;
    }
    return count;
}

void glint_plan_build_options(const glint_plan *plan, char *text, size_t capacity)
{
    size_t used = (size_t)snprintf(
        text, capacity,
        "-cl-std=CL1.2 -w -DGLINT_WIDTH=%d -DGLINT_BVH_WIDTH=%d -DGLINT_DOUBLE=%d "
        "-DGLINT_HALF_TEXELS=%d -DGLINT_STACK_CAPACITY=%d -DGLINT_MEDIA_BITS=%d "
        "-DGLINT_MEDIA_CAPACITY=%d -DGLINT_TRAVERSAL_STACK=%d -DGLINT_TILES=%d",
        plan->kernel_width, plan->bvh_width, plan->precision == GLINT_PRECISION_DOUBLE,
        plan->half_texels, plan->stack_capacity, plan->media_bits, plan->media_capacity,
        plan->traversal_stack, plan->tiles);
    for (int i = 0; i < GLINT_FEATURE_COUNT && used < capacity; i++) {
        used += (size_t)snprintf(text + used, capacity - used, " -DGLINT_%s=%d",
                                 glint_feature_name((glint_feature)i), plan->features[i].compiled);
    }
    if (plan->build_tag != 0 && used < capacity) {
        snprintf(text + used, capacity - used, " -DGLINT_BUILD_TAG=%u", plan->build_tag);
    }
}

void glint_plan_describe(const glint_plan *plan, char *text, size_t capacity)
{
    char depth[32];
    snprintf(depth, sizeof depth,
             plan->depth_is_exact  ? "auto (%d is exact)"
             : plan->depth_is_auto ? "auto (at most %d)"
                                   : "%d",
             plan->depth);
    snprintf(
        text, capacity,
        "shading %s, depth %s, precision %s, %s texels, filter %s, width %d, %d of %d features",
        glint_shading_name(plan->shading), depth,
        plan->precision == GLINT_PRECISION_DOUBLE ? "double" : "float",
        plan->half_texels ? "half" : "float",
        plan->features[GLINT_FEATURE_MIP_LEVELS].compiled ? "mip" : "bilinear", plan->kernel_width,
        glint_plan_feature_count(plan), GLINT_FEATURE_COUNT);
}
