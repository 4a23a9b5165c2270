// Makes plans of random scenes, settings and devices. Each must have what its features need and
// nothing that they exclude (kernels/features.h). Prints the build options of a few plans: together
// they hold every two features on and off, in all ways that some plan had. tests/lint_kernels
// compiles them.
//
//     plan_choices [ROUNDS]
//     plan_choices --seen REPORT.json
//
// The second form prints no options. It names every two features that a plan has together, but no
// judged frame of the self-test has, whose JSON REPORT is. Exit status 1 if there are such.
#include "base/random.h"
#include "kernels/layout.h"
#include "render/plan.h"
#include "render/plan_device.h"
#include "render/plan_features.h"
#include "render/plan_make.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MATERIALS = 3, KEPT_MAX = 4096 };

static glint_random source = {1};

// Some plans have features that no scene or setting needs. No frame has these outside of tests.
static bool takes_all = true;

static bool chance(double p)
{
    return glint_random_number(&source) < p;
}

static float one_of(const float *values, size_t count)
{
    return values[(size_t)(glint_random_number(&source) * (double)count)];
}

#define ONE_OF(...)                                                                                \
    one_of((const float[]){__VA_ARGS__}, sizeof((const float[]){__VA_ARGS__}) / sizeof(float))

static glint_material random_material(bool textured)
{
    glint_material m = glint_material_default;
    m.metallic = ONE_OF(0, 0, 0.5F, 1);
    m.roughness = ONE_OF(0, 0, 0.4F, 1);
    m.base_color[1] = ONE_OF(1, 0.5F);
    m.emission[0] = ONE_OF(0, 0, 0, 2);
    m.transmission = ONE_OF(0, 0, 0.5F, 1);
    m.thickness = ONE_OF(0, 1);
    m.ior = ONE_OF(1.5F, 1, 1.33F, 8);
    m.attenuation_distance = ONE_OF(INFINITY, 2);
    m.attenuation_color[1] = ONE_OF(1, 0.5F);
    m.dispersion = ONE_OF(0, 0, 1);
    m.specular = ONE_OF(1, 1, 0.5F, 0);
    m.specular_color[2] = ONE_OF(1, 1, 0.5F);
    m.clearcoat = ONE_OF(0, 0, 0.5F, 1);
    m.clearcoat_roughness = ONE_OF(0, 0.3F);
    m.iridescence = ONE_OF(0, 0, 1);
    m.iridescence_thickness[1] = 400;
    m.anisotropy = ONE_OF(0, 0, 0.7F);
    m.sheen_color[0] = ONE_OF(0, 0, 1);
    m.sheen_roughness = ONE_OF(0.3F, 1);
    m.diffuse_transmission = ONE_OF(0, 0, 0.7F);
    m.unlit = chance(0.1);
    m.mirror = ONE_OF(-1, -1, -1, -1, -1, 0, 0.5F, 1);
    m.priority = ONE_OF(0, 0, 3);
    m.alpha_mode = (glint_alpha_mode)(int)ONE_OF(GLINT_ALPHA_OPAQUE, GLINT_ALPHA_OPAQUE,
                                                 GLINT_ALPHA_MASK, GLINT_ALPHA_BLEND);
    m.alpha = ONE_OF(1, 0.5F, 0);
    m.has_vertex_colors = chance(0.2);
    for (int slot = 0; textured && slot < GLINT_TEXTURE_SLOTS; slot++) {
        m.textures[slot].image = chance(0.2) ? 1 : 0;
        m.textures[slot].texcoord = chance(0.2) ? 1 : 0;
    }
    return m;
}

static glint_settings random_settings(void)
{
    static const uint32_t list[GLINT_LIST_COLUMNS];
    glint_settings s = glint_settings_default;
    s.depth = (int)ONE_OF(0, 0, 1, 3);
    s.min_weight = (double)ONE_OF((float)s.min_weight, 0);
    s.samples_per_axis = (int)ONE_OF(1, 1, 3);
    s.transparent = chance(0.2);
    s.env_rotate = chance(0.2) ? 30 : 0;
    s.precision = chance(0.2) ? GLINT_PRECISION_DOUBLE : GLINT_PRECISION_FLOAT;
    s.mend = chance(0.1) ? 0.5 : 0;
    s.fresnel = chance(0.15) ? GLINT_FRESNEL_NONE : GLINT_FRESNEL_EXACT;
    s.output = chance(0.1) ? GLINT_OUTPUT_HITS : GLINT_OUTPUT_COLOR;
    s.texels = chance(0.2) ? GLINT_TEXELS_FLOAT : GLINT_TEXELS_AUTO;
    s.filter = chance(0.2) ? GLINT_FILTER_MIP : GLINT_FILTER_BILINEAR;
    s.anisotropy = (int)ONE_OF(1, 8);
    s.irradiance = chance(0.2) ? GLINT_IRRADIANCE_SH : GLINT_IRRADIANCE_EXACT;
    s.lights = chance(0.2) ? GLINT_LIGHTS_NONE : GLINT_LIGHTS_FILE;
    s.roughness = (glint_roughness)(int)ONE_OF(GLINT_ROUGHNESS_FAST, GLINT_ROUGHNESS_FAST,
                                               GLINT_ROUGHNESS_EXACT, GLINT_ROUGHNESS_SMOOTH);
    s.proxy = chance(0.1);
    s.shading = (glint_shading)(int)ONE_OF(
        GLINT_SHADING_PIXEL, GLINT_SHADING_PIXEL, GLINT_SHADING_PIXEL, GLINT_SHADING_PIXEL,
        GLINT_SHADING_VERTEX_COLOR, GLINT_SHADING_VERTEX_DIRECTION);
    s.terms = chance(0.05) ? 2 : 0;
    s.aovs = chance(0.1) ? GLINT_AOV_BIT(GLINT_AOV_TIR) : 0;
    s.truncation_squares = chance(0.1);
    s.list = chance(0.1) ? list : NULL;
    s.list_rows = s.list != NULL ? 1 : 0;
    s.all_features = takes_all && chance(0.02);
    return s;
}

// A scene and what its pointers name.
typedef struct random_scene {
    glint_scene scene;
    glint_material materials[MATERIALS];
    glint_instance instances[MATERIALS];
    glint_component components[MATERIALS];
    glint_punctual_light light;
} random_scene;

static void fill_scene(random_scene *s)
{
    static uint32_t material_of[MATERIALS] = {0, 1, 2};
    static float normals[9 * MATERIALS];
    static float positions[9 * MATERIALS] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 1, 0, 1, 1, 1, 0};
    static glint_texture texture = {.width = 1, .height = 1};
    static glint_textures textures = {.count = 1, .textures = &texture};
    const size_t count = chance(0.02) ? 0 : chance(0.5) ? 1 : MATERIALS;
    const bool textured = count > 0 && chance(0.5); // as in files, tangents come with coordinates
    for (size_t i = 0; i < count; i++) {
        const uint32_t number = (uint32_t)i;
        s->materials[i] = random_material(textured);
        s->instances[i] =
            (glint_instance){.first_triangle = i, .triangle_count = 1, .material = number};
        s->components[i] = (glint_component){.instance = number,
                                             .material = number,
                                             .triangle_count = 1,
                                             .closed = true,
                                             .convex = chance(0.5)};
    }
    s->light = (glint_punctual_light){.kind = GLINT_PUNCTUAL_POINT, .color = {1, 1, 1}};
    s->scene = (glint_scene){
        .triangle_count = count,
        .material_count = count,
        .materials = s->materials,
        .instance_count = count,
        .instances = s->instances,
        .unit = 1,
        .positions = positions,
        .material_of = material_of,
        .normals = chance(0.7) ? normals : NULL,
        .textures = textured ? &textures : NULL,
        .attribute_set = {.texcoords = textured,
                          .second_texcoords = textured && chance(0.5),
                          .colors = count > 0 && chance(0.3),
                          .tangents = textured && chance(0.5)},
        .lights = &s->light,
        .light_count = chance(0.3) ? 1 : 0,
        .parts = {.count = count > 1 && chance(0.2) ? 2 : 0},
        .moves = chance(0.1),
    };
}

static glint_status random_plan(glint_plan *plan, glint_error *error)
{
    static const glint_capabilities devices[] = {
        {.is_cpu = true, .has_double = true, .native_float_width = 16, .name = "wide"},
        {.is_cpu = true, .has_double = true, .native_float_width = 4, .name = "narrow"},
        {.is_gpu = true, .has_double = true, .native_float_width = 1, .name = "gpu"}};
    glint_solid_record records[MATERIALS] = {{0}};
    random_scene s;
    fill_scene(&s);
    const size_t count = s.scene.triangle_count;
    const glint_topology topology = {.component_count = count, .components = s.components};
    glint_contact contact = {.components = {0, 1}, .overlap = true};
    const glint_solids solids = {.contact_count = count > 1 && chance(0.5) ? 1 : 0,
                                 .contacts = &contact,
                                 .component_count = count,
                                 .mixed_count = count > 1 && chance(0.1),
                                 .medium_count = count,
                                 .of_triangle = records};
    const glint_cube none = {0};
    const glint_settings settings = random_settings();
    const glint_sight sight =
        glint_sight_find(&s.scene, &topology, glint_settings_heed_roughness(&settings));
    TRY(glint_plan_make(&(glint_plan_inputs){.scene = &s.scene,
                                             .topology = &topology,
                                             .solids = chance(0.7) ? &solids : NULL,
                                             .sight = chance(0.5) ? &sight : NULL,
                                             .environment = &none,
                                             .device = &devices[(int)ONE_OF(0, 1, 2)],
                                             .settings = &settings},
                        plan, error));
    if (plan->box_count > 0 && chance(0.3)) { // the camera is in the bounds of a solid
        glint_plan_decide_inside(true, plan);
        glint_plan_decide_paths(plan);
    }
    return GLINT_OK;
}

// ------------------------------------------------------------------------------------------------

// Says which features lack a need, or stand beside what they exclude.
static int find_faults(const glint_plan *plan)
{
    int faults = 0;
#define DECLARE(name, ...) const bool GLINT_##name = plan->features[GLINT_FEATURE_##name].compiled;
    GLINT_FEATURES(DECLARE)
#undef DECLARE
    const bool GLINT_TILES = plan->tiles;
#define CHECK(name, meaning, needs, excludes, ...)                                                 \
    if (GLINT_##name && (!(needs) || (excludes))) {                                                \
        fprintf(stderr, "plan_choices: %s is compiled against features.h\n", #name);               \
        faults++;                                                                                  \
    }
    GLINT_FEATURES(CHECK)
#undef CHECK
    return faults;
}

// The ways in which two features are compiled: bit 2a + b, where a and b are 0 or 1.
typedef unsigned char pairs[GLINT_FEATURE_COUNT][GLINT_FEATURE_COUNT];

static int way_of(const glint_plan *plan, int i, int k)
{
    return 1 << (2 * (int)plan->features[i].compiled + (int)plan->features[k].compiled);
}

// Adds a plan's pairs. Returns how many are new.
static int add_pairs(const glint_plan *plan, pairs seen)
{
    int added = 0;
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        for (int k = 0; k < i; k++) {
            const int way = way_of(plan, i, k);
            added += (seen[i][k] & way) == 0;
            seen[i][k] |= (unsigned char)way;
        }
    }
    return added;
}

static int count_ways(pairs seen, int ways)
{
    int count = 0;
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        for (int k = 0; k < i; k++) {
            count += __builtin_popcount(seen[i][k] & (unsigned)ways);
        }
    }
    return count;
}

// Prints plans until all pairs are there, each time the one with most new pairs.
static int print_cover(const glint_plan *plans, size_t count)
{
    static pairs covered;
    for (int printed = 0;; printed++) {
        int most = 0;
        size_t best = 0;
        for (size_t p = 0; p < count; p++) {
            pairs trial;
            memcpy(trial, covered, sizeof trial);
            const int added = add_pairs(&plans[p], trial);
            best = added > most ? p : best;
            most = added > most ? added : most;
        }
        if (most == 0) {
            return printed;
        }
        add_pairs(&plans[best], covered);
        char options[GLINT_BUILD_OPTIONS_BYTES];
        glint_plan_build_options(&plans[best], options);
        printf("%s\n", options);
    }
}

// ---- Pairs in the self-test ---------------------------------------------------------------------

static int feature_named(const char *name, size_t length)
{
    int i = 0;
    while (i < GLINT_FEATURE_COUNT &&
           (strncmp(glint_feature_name((glint_feature)i), name, length) != 0 ||
            glint_feature_name((glint_feature)i)[length] != '\0')) {
        i++;
    }
    return i;
}

// Adds the pairs of a set, which is written as names between spaces. False for an unknown name.
static bool add_set(const char *names, pairs seen)
{
    glint_plan plan = {0};
    while (*names != '\0') {
        const size_t length = strcspn(names, " ");
        const int i = feature_named(names, length);
        if (i == GLINT_FEATURE_COUNT) {
            return false;
        }
        plan.features[i].compiled = true;
        names += length + (names[length] == ' ');
    }
    add_pairs(&plan, seen);
    return true;
}

static bool read_report(const char *path, pairs seen)
{
    json_error_t error;
    json_t *report = json_load_file(path, 0, &error);
    const json_t *result = NULL, *set = NULL;
    size_t r = 0, k = 0;
    bool valid = json_array_size(json_object_get(report, "results")) > 0;
    json_array_foreach(json_object_get(report, "results"), r, result)
    {
        json_array_foreach(json_object_get(result, "feature_sets"), k, set)
        {
            valid = valid && json_is_string(set) && add_set(json_string_value(set), seen);
        }
    }
    json_decref(report);
    return valid;
}

// The features whose pairs are not all judged yet: the oracle takes long for lobes, and for media
// that it finds at points.
static bool is_incomplete(int feature)
{
    return feature == GLINT_FEATURE_ROUGH || feature == GLINT_FEATURE_BRUSHED ||
           feature == GLINT_FEATURE_SHEEN || feature == GLINT_FEATURE_FACETS ||
           feature == GLINT_FEATURE_OVERLAPS;
}

// Names the pairs that plans have together, but no set of the report.
static int find_unseen(const char *path, pairs possible)
{
    static pairs seen;
    int unseen = 0, left = 0;
    if (!read_report(path, seen)) {
        fprintf(stderr, "plan_choices: %s: no report of glint selftest\n", path);
        return 1;
    }
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        for (int k = 0; k < i; k++) {
            if ((possible[i][k] & 8) == 0 || (seen[i][k] & 8) != 0) {
                continue;
            }
            if (is_incomplete(i) || is_incomplete(k)) {
                left++;
                continue;
            }
            printf("no judged frame has %s and %s\n", glint_feature_name((glint_feature)k),
                   glint_feature_name((glint_feature)i));
            unseen++;
        }
    }
    printf("of %d pairs of features that plans have, %d are in no judged frame: %d of lobes and of "
           "overlapping solids, which are not complete yet, and %d others\n",
           count_ways(possible, 8), left + unseen, left, unseen);
    return unseen > 0;
}

// ------------------------------------------------------------------------------------------------

// Keeps the plans that bring new pairs. Returns the number of faults.
static int make_plans(int rounds, glint_plan *kept, size_t *count, pairs seen)
{
    int faults = 0;
    for (int i = 0; i < rounds && faults < 20; i++) {
        glint_error error = {0};
        glint_plan plan;
        if (random_plan(&plan, &error) != GLINT_OK) { // settings that exclude each other
            glint_error_free(&error);
            continue;
        }
        faults += find_faults(&plan);
        if (add_pairs(&plan, seen) > 0 && *count < KEPT_MAX) {
            kept[(*count)++] = plan;
        }
    }
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        bool ever = false;
        for (size_t p = 0; p < *count; p++) {
            ever = ever || kept[p].features[i].compiled;
        }
        if (!ever) {
            fprintf(stderr, "plan_choices: no plan has %s\n", glint_feature_name((glint_feature)i));
            faults++;
        }
    }
    return faults;
}

int main(int argc, char **argv)
{
    const bool compares = argc == 3 && strcmp(argv[1], "--seen") == 0;
    const int rounds = argc == 2 ? atoi(argv[1]) : 100000;
    glint_plan *kept = calloc(KEPT_MAX, sizeof *kept);
    static pairs seen;
    size_t count = 0;
    if (kept == NULL) {
        return 1;
    }
    takes_all = !compares;
    int faults = make_plans(rounds, kept, &count, seen);
    if (compares) {
        faults += find_unseen(argv[2], seen);
    } else {
        const int printed = print_cover(kept, count);
        fprintf(stderr,
                "plan_choices: of %d features, %d pairs are on together; %d programs hold all %d "
                "ways of two features\n",
                (int)GLINT_FEATURE_COUNT, count_ways(seen, 8), printed, count_ways(seen, 15));
    }
    free(kept);
    return faults > 0;
}
