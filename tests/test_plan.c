// Tests the plan: scene, settings and device decide which features compile, and the plan gives
// reasons.
#include "kernels/layout.h"
#include "render/plan.h"
#include "render/plan_make.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const glint_capabilities wide_cpu = {
    .is_cpu = true, .has_double = true, .native_float_width = 16, .name = "wide"};
static const glint_capabilities narrow_cpu = {
    .is_cpu = true, .has_double = true, .native_float_width = 4, .name = "narrow"};
static const glint_capabilities plain_gpu = {
    .is_gpu = true, .native_float_width = 1, .name = "gpu"};

// One triangle for each material.
typedef struct test_scene {
    glint_scene scene;
    glint_material materials[4];
    glint_instance instances[4];
} test_scene;

static const glint_material white_paint = {.base_color = {1, 1, 1},
                                           .roughness = 1,
                                           .ior = 1.5f,
                                           GLINT_MATERIAL_SPECULAR,
                                           .attenuation_distance = INFINITY,
                                           .attenuation_color = {1, 1, 1},
                                           .mirror = -1};

static void make_scene(test_scene *s, const glint_material *materials, size_t count)
{
    *s = (test_scene){0};
    for (size_t i = 0; i < count; i++) {
        s->materials[i] = materials[i];
        s->instances[i] = (glint_instance){.triangle_count = 1, .material = (uint32_t)i};
    }
    s->scene = (glint_scene){.triangle_count = count,
                             .material_count = count,
                             .materials = s->materials,
                             .instance_count = count,
                             .instances = s->instances,
                             .unit = 1};
}

// Checks needs and exclusions of features (kernels/features.h).
static void check_features(const glint_plan *plan)
{
#define DECLARE(name, ...) const bool GLINT_##name = plan->features[GLINT_FEATURE_##name].compiled;
    GLINT_FEATURES(DECLARE)
#undef DECLARE
    const bool GLINT_TILES = plan->tiles;
#define CHECK(name, meaning, needs, excludes, ...)                                                 \
    assert_true(!GLINT_##name || ((needs) && !(excludes)));
    GLINT_FEATURES(CHECK)
#undef CHECK
}

// Makes a plan of `inputs` and a topology.
static glint_status plan_of(glint_plan_inputs inputs, glint_plan *plan, glint_error *error)
{
    // No component is proved convex, so solids may nest.
    static glint_component solid = {.instance = 0, .triangle_count = 1};
    const glint_topology topology = {.component_count = 1, .components = &solid};
    inputs.topology = &topology;
    TRY(glint_plan_make(&inputs, plan, error));
    check_features(plan);
    return GLINT_OK;
}

static glint_status plan_for(const test_scene *s, const glint_capabilities *device,
                             const glint_settings *settings, glint_plan *plan, glint_error *error)
{
    const glint_cube none = {0};
    return plan_of(
        (glint_plan_inputs){
            .scene = &s->scene, .environment = &none, .device = device, .settings = settings},
        plan, error);
}

static bool compiles(const glint_plan *plan, glint_feature feature)
{
    return plan->features[feature].compiled;
}

// Only rough metal and paint have lobes, and only rough glass has facets. Without Fresnel's term
// there is no coat, but metal mixed with paint has its lobe.
static void rough_materials_reflect_lobes(void **state)
{
    (void)state;
    static const struct {
        float metallic, roughness, transmission;
        glint_fresnel fresnel;
        glint_roughness setting;
        bool lobes, facets;
    } kinds[] = {
        {1, 0.5F, 0, GLINT_FRESNEL_EXACT, GLINT_ROUGHNESS_FAST, true, false},
        {1, 0.009F, 0, GLINT_FRESNEL_EXACT, GLINT_ROUGHNESS_FAST, false, false},
        {1, 0.5F, 0, GLINT_FRESNEL_EXACT, GLINT_ROUGHNESS_SMOOTH, false, false},
        {1, 0.5F, 0, GLINT_FRESNEL_NONE, GLINT_ROUGHNESS_EXACT, true, false},
        {0, 0.5F, 0, GLINT_FRESNEL_EXACT, GLINT_ROUGHNESS_FAST, true, false},
        {0, 0.5F, 0, GLINT_FRESNEL_NONE, GLINT_ROUGHNESS_FAST, false, false},
        {0.5F, 0.5F, 0, GLINT_FRESNEL_NONE, GLINT_ROUGHNESS_FAST, true, false},
        {0, 0.5F, 1, GLINT_FRESNEL_EXACT, GLINT_ROUGHNESS_FAST, false, true},
        {0, 0.5F, 0.5F, GLINT_FRESNEL_NONE, GLINT_ROUGHNESS_EXACT, false, true},
        {0, 0.009F, 1, GLINT_FRESNEL_EXACT, GLINT_ROUGHNESS_FAST, false, false},
        {0, 0.5F, 1, GLINT_FRESNEL_EXACT, GLINT_ROUGHNESS_SMOOTH, false, false},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        glint_material material = white_paint;
        material.metallic = kinds[i].metallic;
        material.roughness = kinds[i].roughness;
        material.transmission = kinds[i].transmission;
        glint_settings settings = glint_settings_default;
        settings.fresnel = kinds[i].fresnel;
        settings.roughness = kinds[i].setting;
        test_scene s;
        make_scene(&s, &material, 1);
        glint_plan plan;
        assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
        if (compiles(&plan, GLINT_FEATURE_ROUGH) != kinds[i].lobes ||
            compiles(&plan, GLINT_FEATURE_FACETS) != kinds[i].facets) {
            fail_msg("kind %zu", i);
        }
    }
}

// Only solids disperse light, and only in pixels with colours.
static void dispersion_is_compiled_where_it_is_seen(void **state)
{
    (void)state;
    static const struct {
        float thickness, dispersion;
        int wavelengths, terms;
        bool disperses;
    } kinds[] = {
        {1, 1, 3, 0, true},  {0, 1, 3, 0, false},  {1, 0, 3, 0, false},
        {1, 1, 1, 0, false}, {1, 1, 16, 4, false},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        glint_material material = white_paint;
        material.transmission = 1;
        material.thickness = kinds[i].thickness;
        material.dispersion = kinds[i].dispersion;
        glint_settings settings = glint_settings_default;
        settings.wavelengths = kinds[i].wavelengths;
        settings.terms = kinds[i].terms;
        test_scene s;
        make_scene(&s, &material, 1);
        glint_plan plan;
        assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
        if (compiles(&plan, GLINT_FEATURE_DISPERSION) != kinds[i].disperses) {
            fail_msg("kind %zu", i);
        }
    }
}

static void a_mirror_compiles_no_glass_and_no_paint(void **state)
{
    (void)state;
    glint_material mirror = white_paint;
    mirror.metallic = 1;
    mirror.roughness = 0;
    test_scene s;
    make_scene(&s, &mirror, 1);
    glint_plan plan;
    assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_MIRROR));
    assert_true(compiles(&plan, GLINT_FEATURE_INTERREFLECTION));
    assert_int_equal(glint_plan_feature_count(&plan), 3); // and GEOMETRY, because it is white
    assert_int_equal(plan.stack_capacity, 0);
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        assert_true(plan.features[i].reason[0] != '\0');
    }
    mirror.base_color[2] = 0.5f;
    make_scene(&s, &mirror, 1);
    assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_TINT) && compiles(&plan, GLINT_FEATURE_FRESNEL));
}

static void glass_compiles_what_its_volume_asks_for(void **state)
{
    (void)state;
    glint_material glass = white_paint;
    glass.transmission = 1;
    test_scene s;
    glint_plan plan;
    make_scene(&s, &glass, 1);
    assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_THIN_WALL) && !compiles(&plan, GLINT_FEATURE_SOLID));
    assert_false(compiles(&plan, GLINT_FEATURE_PAINT));
    glass.thickness = 1;
    make_scene(&s, &glass, 1);
    assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_SOLID) && !compiles(&plan, GLINT_FEATURE_THIN_WALL));
    assert_true(compiles(&plan, GLINT_FEATURE_NESTED_MEDIA));
    assert_false(compiles(&plan, GLINT_FEATURE_ABSORPTION));
    glass.attenuation_distance = 2;
    glass.attenuation_color[1] = 0.5f;
    make_scene(&s, &glass, 1);
    assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_ABSORPTION));
}

static void unlit_and_blended_materials_hide_their_other_factors(void **state)
{
    (void)state;
    glint_material pair[2] = {white_paint, white_paint};
    pair[0].unlit = true;
    pair[0].transmission = 1;
    pair[0].emission[0] = 3;
    pair[1].mirror = 0.5f;
    pair[1].metallic = 1;
    test_scene s;
    make_scene(&s, pair, 2);
    glint_plan plan;
    assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_UNLIT) && compiles(&plan, GLINT_FEATURE_BLEND));
    assert_true(compiles(&plan, GLINT_FEATURE_MANY_MATERIALS));
    assert_false(compiles(&plan, GLINT_FEATURE_GLASS) || compiles(&plan, GLINT_FEATURE_MIRROR));
    assert_false(compiles(&plan, GLINT_FEATURE_EMISSION) || compiles(&plan, GLINT_FEATURE_PAINT));
}

static void lights_are_compiled_where_paint_shows_them(void **state)
{
    (void)state;
    static glint_punctual_light lights[GLINT_PUNCTUAL_LIGHTS_MAX + 1];
    glint_settings settings = glint_settings_default;
    glint_material blend = white_paint;
    blend.mirror = 0.5f;
    test_scene s;
    glint_plan plan;
    make_scene(&s, &white_paint, 1);
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_false(compiles(&plan, GLINT_FEATURE_LIGHTS));
    s.scene.lights = lights;
    s.scene.light_count = GLINT_PUNCTUAL_LIGHTS_MAX;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_LIGHTS));
    assert_string_equal(plan.features[GLINT_FEATURE_LIGHTS].reason, "1024 lights");
    make_scene(&s, &blend, 1);
    s.scene.light_count = 1;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_true(compiles(&plan, GLINT_FEATURE_LIGHTS));
    settings.shading = GLINT_SHADING_VERTEX_DIRECTION;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_false(compiles(&plan, GLINT_FEATURE_LIGHTS));
    settings.shading = GLINT_SHADING_PIXEL;
    settings.output = GLINT_OUTPUT_HITS;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_false(compiles(&plan, GLINT_FEATURE_LIGHTS));
    settings.output = GLINT_OUTPUT_COLOR;
    s.scene.light_count = GLINT_PUNCTUAL_LIGHTS_MAX + 1;
    glint_error error = {0};
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "1025 lights shine, 1024 at most"));
    settings.lights = GLINT_LIGHTS_NONE;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
}

static void the_width_follows_the_device(void **state)
{
    (void)state;
    test_scene s;
    make_scene(&s, &white_paint, 1);
    glint_settings settings = glint_settings_default;
    glint_plan plan;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_true(plan.kernel_width == 16 && plan.bvh_width == 16);
    assert_int_equal(plan_for(&s, &narrow_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_true(plan.kernel_width == 8 && plan.bvh_width == 8);
    assert_int_equal(plan_for(&s, &plain_gpu, &settings, &plan, NULL), GLINT_OK);
    assert_true(plan.kernel_width == 1 && plan.bvh_width == 8);
    settings.precision = GLINT_PRECISION_DOUBLE;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_int_equal(plan.kernel_width, 8);
    glint_error error = {0};
    assert_int_equal(plan_for(&s, &plain_gpu, &settings, &plan, &error), GLINT_DEVICE_LACKS);
    assert_non_null(strstr(error.message, "double"));
}

static void the_stack_holds_every_branch_that_the_least_weight_allows(void **state)
{
    (void)state;
    glint_material glass = white_paint;
    glass.transmission = 1;
    glass.roughness = 0;
    test_scene s;
    make_scene(&s, &glass, 1);
    glint_settings settings = glint_settings_default;
    glint_plan plan;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_int_equal(plan.stack_capacity, 18); // the least: log2(1024) + 2 are needed
    settings.min_weight = 0x1p-20;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_int_equal(plan.stack_capacity, 22); // log2(2^20) + 1 waiting, and the warning slot
    settings.depth = 20;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_int_equal(plan.stack_capacity, 21);
    settings.min_weight = 0;
    settings.depth = 1000;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_int_equal(plan.stack_capacity, GLINT_DEPTH_MAX + 1);
    assert_non_null(strstr(plan.stack_reason, "truncated"));
    assert_true(plan.tiles);
    settings.precision = GLINT_PRECISION_DOUBLE;
    settings.kernel_width = 16;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_false(plan.tiles); // 256 pixels × 65 branches × 104 bytes
    assert_non_null(strstr(plan.tiles_reason, "branches of a tile would take 1690 KiB"));
    settings.filter = GLINT_FILTER_MIP; // each branch takes 120 bytes
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_non_null(strstr(plan.tiles_reason, "branches of a tile would take 1950 KiB"));
    glass.roughness = 0.5F; // each branch takes 136 bytes
    make_scene(&s, &glass, 1);
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_non_null(strstr(plan.tiles_reason, "branches of a tile would take 2210 KiB"));
}

static void the_plan_says_how_secondary_rays_are_traced(void **state)
{
    (void)state;
    test_scene s;
    glint_material mirror = white_paint;
    mirror.metallic = 1;
    make_scene(&s, &mirror, 1);
    glint_settings settings = glint_settings_default;
    glint_plan plan;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_non_null(strstr(plan.secondary, "together"));
    settings.tile_packets = 1;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_null(strstr(plan.secondary, "together"));
    settings.kernel_width = 1;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_string_equal(plan.secondary, "one by one");
    settings.tile_packets = 16;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_string_equal(plan.secondary, "one by one, together where a tile's run alike");
    settings.depth = 1;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_string_equal(plan.secondary, "none");
}

static void media_take_as_few_bits_as_can_name_them(void **state)
{
    (void)state;
    glint_material glass[4] = {white_paint, white_paint, white_paint, white_paint};
    for (int i = 0; i < 4; i++) {
        glass[i].transmission = 1;
        glass[i].thickness = 1;
    }
    static const int bits[] = {0, 1, 2, 2, 3};
    for (size_t count = 1; count <= 4; count++) {
        test_scene s;
        make_scene(&s, glass, count);
        glint_plan plan;
        assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
        assert_int_equal(plan.media_bits, bits[count]);
        assert_true(plan.media_bits * plan.media_capacity <= 30);
    }
}

// Makes plans for a map of the value 0.3 with one texel of `brightest`, all multiplied by `scale`.
static glint_status plan_texels(float brightest, float scale, const glint_settings *settings,
                                glint_plan *plan, glint_error *error)
{
    test_scene s;
    make_scene(&s, &white_paint, 1);
    glint_cube cube;
    assert_int_equal(glint_cube_create(8, &cube, NULL), GLINT_OK);
    for (size_t i = 0; i < glint_cube_size(&cube); i++) {
        cube.texels[i] = 0.3f * scale;
    }
    glint_cube_texel(&cube, 2, 3, 4)[1] = brightest * scale;
    glint_status status = plan_of(
        (glint_plan_inputs){
            .scene = &s.scene, .environment = &cube, .device = &wide_cpu, .settings = settings},
        plan, error);
    size_t bytes = glint_cube_size(&cube) * sizeof(float);
    if (status == GLINT_OK) {
        assert_true(plan->texels_reason[0] != '\0');
        assert_int_equal(plan->environment_bytes, plan->half_texels ? bytes / 2 : bytes);
        assert_true((plan->texels_rmse > 0) == plan->half_texels);
    }
    glint_cube_free(&cube);
    return status;
}

static void texels_are_half_where_that_does_no_harm(void **state)
{
    (void)state;
    glint_settings settings = glint_settings_default;
    glint_plan plan;
    assert_int_equal(plan_texels(1, 1, &settings, &plan, NULL), GLINT_OK);
    assert_true(plan.half_texels);
    // A light counts by its solid angle, however bright.
    assert_int_equal(plan_texels(60001, 1, &settings, &plan, NULL), GLINT_OK);
    assert_true(plan.half_texels);
    assert_int_equal(plan_texels(91000, 1, &settings, &plan, NULL), GLINT_OK);
    assert_false(plan.half_texels);
    assert_non_null(strstr(plan.texels_reason, "91000"));
    // In a dark map half has no digits left.
    assert_int_equal(plan_texels(1, 1e-5f, &settings, &plan, NULL), GLINT_OK);
    assert_false(plan.half_texels);
    settings.precision = GLINT_PRECISION_DOUBLE;
    assert_int_equal(plan_texels(1, 1, &settings, &plan, NULL), GLINT_OK);
    assert_false(plan.half_texels);
}

static void texels_are_what_is_asked_for_or_refused(void **state)
{
    (void)state;
    glint_settings settings = glint_settings_default;
    glint_plan plan;
    glint_error error = {0};
    settings.texels = GLINT_TEXELS_FLOAT;
    assert_int_equal(plan_texels(1, 1, &settings, &plan, NULL), GLINT_OK);
    assert_false(plan.half_texels);
    settings.texels = GLINT_TEXELS_HALF;
    settings.precision = GLINT_PRECISION_DOUBLE;
    assert_int_equal(plan_texels(1, 1e-5f, &settings, &plan, NULL), GLINT_OK);
    assert_true(plan.half_texels);
    assert_int_equal(plan_texels(91000, 1, &settings, &plan, &error), GLINT_USAGE);
    assert_non_null(strstr(error.message, "91000"));
    assert_non_null(strstr(error.message, "--texels float"));
    assert_int_equal(plan_texels(NAN, 1, &settings, &plan, NULL), GLINT_USAGE);
}

static void settings_out_of_range_are_usage_errors(void **state)
{
    (void)state;
    test_scene s;
    make_scene(&s, &white_paint, 1);
    glint_settings bad[9];
    for (int i = 0; i < 9; i++) {
        bad[i] = glint_settings_default;
    }
    bad[0].width = 0;
    bad[1].height = -1;
    bad[2].samples_per_axis = 0;
    bad[3].depth = -1;
    bad[4].min_weight = NAN;
    bad[5].min_weight = 1.5;
    bad[6].env_rotate = INFINITY;
    bad[7].kernel_width = 4;
    bad[8].aovs = GLINT_AOV_VALID + 1;
    for (int i = 0; i < 9; i++) {
        glint_plan plan;
        glint_error error = {0};
        assert_int_equal(plan_for(&s, &wide_cpu, &bad[i], &plan, &error), GLINT_USAGE);
        assert_true(strncmp(error.message, "--", 2) == 0);
    }
}

static void layers_are_compiled_where_they_are_asked_for(void **state)
{
    (void)state;
    test_scene s;
    make_scene(&s, &white_paint, 1);
    glint_settings settings = glint_settings_default;
    glint_plan plan;
    // DIAGNOSTICS stays off: without layers it has no output.
    settings.all_features = true;
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_false(plan.features[GLINT_FEATURE_DIAGNOSTICS].compiled);
    settings.aovs = GLINT_AOV_BIT(GLINT_AOV_TIR);
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
    assert_true(plan.features[GLINT_FEATURE_DIAGNOSTICS].compiled);
    settings.output = GLINT_OUTPUT_HITS; // hits have no paths to report
    assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_USAGE);
}

// With each kind of material alone, with all kinds, and without any.
static void textures_are_averaged_along_ellipses_unless_one_tap_is_asked_for(void **state)
{
    (void)state;
    test_scene s;
    make_scene(&s, &white_paint, 1);
    glint_settings settings = glint_settings_default;
    for (int k = 0; k < 4; k++) {
        s.scene.attribute_set.texcoords = k > 0;
        settings.anisotropy = k == 1 ? 1 : 2;
        settings.output = k == 3 ? GLINT_OUTPUT_HITS : GLINT_OUTPUT_COLOR;
        glint_plan plan;
        assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
        assert_int_equal(compiles(&plan, GLINT_FEATURE_TEXTURES), k == 1 || k == 2);
        assert_int_equal(compiles(&plan, GLINT_FEATURE_ANISOTROPY), k == 2);
    }
}

// Without its coat, rough paint is what its base is. Without lobes, metal shows no lights.
static void settings_without_lobes_need_neither_weights_nor_lights(void **state)
{
    (void)state;
    glint_punctual_light light = {.kind = GLINT_PUNCTUAL_POINT};
    for (int i = 0; i < 8; i++) {
        glint_material material = white_paint;
        material.roughness = 0.5F;
        material.specular = 0.5F;
        material.metallic = i & 1 ? 1.0F : 0;
        glint_settings settings = glint_settings_default;
        settings.roughness = i & 2 ? GLINT_ROUGHNESS_SMOOTH : GLINT_ROUGHNESS_FAST;
        settings.terms = i & 4 ? 2 : 0;
        test_scene s;
        make_scene(&s, &material, 1);
        s.scene.lights = &light;
        s.scene.light_count = 1;
        glint_plan plan;
        assert_int_equal(plan_for(&s, &wide_cpu, &settings, &plan, NULL), GLINT_OK);
        const bool lobes = (i & 6) == 0;
        assert_int_equal(compiles(&plan, GLINT_FEATURE_ROUGH), lobes);
        assert_int_equal(compiles(&plan, GLINT_FEATURE_LIGHTS), lobes || (i & 1) == 0);
    }
}

static void features_have_what_they_need_whatever_is_asked_for(void **state)
{
    (void)state;
    glint_material kinds[4] = {white_paint, white_paint, white_paint, white_paint};
    kinds[1].metallic = 0.5f;
    kinds[1].base_color[0] = 0.5f;
    kinds[2].transmission = 1;
    kinds[2].thickness = 1;
    kinds[2].attenuation_distance = 2;
    kinds[2].attenuation_color[0] = 0.5f;
    kinds[3].mirror = 0.5f;
    static const uint32_t list[GLINT_LIST_COLUMNS] = {0};
    for (int asked = 0; asked < 1 << 8; asked++) {
        glint_settings settings = glint_settings_default;
        settings.all_features = asked & 1;
        settings.shading = asked & 2 ? GLINT_SHADING_VERTEX_COLOR : GLINT_SHADING_PIXEL;
        settings.output = asked & 4 ? GLINT_OUTPUT_HITS : GLINT_OUTPUT_COLOR;
        settings.list = asked & 8 ? list : NULL;
        settings.list_rows = asked & 8 ? 1 : 0;
        settings.irradiance = asked & 16 ? GLINT_IRRADIANCE_SH : GLINT_IRRADIANCE_EXACT;
        settings.mend = asked & 32 ? 0.5 : 0;
        settings.fresnel = asked & 64 ? GLINT_FRESNEL_NONE : GLINT_FRESNEL_EXACT;
        settings.truncation_squares = asked & 128;
        for (size_t i = 0; i < 6; i++) {
            test_scene s;
            glint_plan plan;
            make_scene(&s, i < 4 ? &kinds[i] : kinds, i < 4 ? 1 : i == 4 ? 4 : 0);
            const glint_status status = plan_for(&s, &wide_cpu, &settings, &plan, NULL);
            // Some features exclude each other.
            assert_true(status == GLINT_OK || status == GLINT_USAGE);
        }
    }
}

static void every_feature_is_passed_to_the_compiler_as_0_or_1(void **state)
{
    (void)state;
    test_scene s;
    make_scene(&s, &white_paint, 1);
    glint_plan plan;
    assert_int_equal(plan_for(&s, &wide_cpu, &glint_settings_default, &plan, NULL), GLINT_OK);
    char options[GLINT_BUILD_OPTIONS_BYTES];
    glint_plan_build_options(&plan, options);
    for (int i = 0; i < GLINT_FEATURE_COUNT; i++) {
        char wanted[80];
        snprintf(wanted, sizeof wanted, "-DGLINT_%s=%d", glint_feature_name((glint_feature)i),
                 plan.features[i].compiled);
        assert_non_null(strstr(options, wanted));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dispersion_is_compiled_where_it_is_seen),
        cmocka_unit_test(a_mirror_compiles_no_glass_and_no_paint),
        cmocka_unit_test(rough_materials_reflect_lobes),
        cmocka_unit_test(glass_compiles_what_its_volume_asks_for),
        cmocka_unit_test(unlit_and_blended_materials_hide_their_other_factors),
        cmocka_unit_test(settings_without_lobes_need_neither_weights_nor_lights),
        cmocka_unit_test(lights_are_compiled_where_paint_shows_them),
        cmocka_unit_test(the_width_follows_the_device),
        cmocka_unit_test(the_stack_holds_every_branch_that_the_least_weight_allows),
        cmocka_unit_test(the_plan_says_how_secondary_rays_are_traced),
        cmocka_unit_test(media_take_as_few_bits_as_can_name_them),
        cmocka_unit_test(texels_are_half_where_that_does_no_harm),
        cmocka_unit_test(texels_are_what_is_asked_for_or_refused),
        cmocka_unit_test(settings_out_of_range_are_usage_errors),
        cmocka_unit_test(layers_are_compiled_where_they_are_asked_for),
        cmocka_unit_test(textures_are_averaged_along_ellipses_unless_one_tap_is_asked_for),
        cmocka_unit_test(features_have_what_they_need_whatever_is_asked_for),
        cmocka_unit_test(every_feature_is_passed_to_the_compiler_as_0_or_1),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
