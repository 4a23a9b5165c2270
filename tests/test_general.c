// General kernels give the bits of special kernels. Scenes of scenes/ with every kind of setting,
// and scenes whose materials have lobes chosen by chance, are rendered with both. GLINT_TEST_ROUNDS
// scenes of the second kind (4).
#include "base/random.h"
#include "render/general.h"
#include "support/render.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- Comparison --------------------------------------------------------------------------------

static void render_by(glint_kernel_choice kernels, const glint_scene *scene,
                      glint_settings settings, const char *what, test_frame *frame)
{
    settings.kernels = kernels;
    glint_error error = {0};
    glint_camera camera;
    assert_int_equal(glint_scene_camera(scene, NULL, &camera, &error), GLINT_OK);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = scene,
                                          .environment = test_studio(),
                                          .settings = &settings};
    glint_renderer *renderer;
    if (glint_renderer_create(&inputs, &renderer, &error) != GLINT_OK) {
        print_error("%s: %s\n%s\n", what, error.message,
                    error.details != NULL ? error.details : "");
        fail();
    }
    const glint_frame_request request = {renderer, &camera, NULL, &frame->image, &frame->report};
    assert_int_equal(glint_renderer_frame(&request, &error), GLINT_OK);
    frame->plan = *glint_renderer_plan(renderer);
    if (settings.aovs != 0) {
        assert_int_equal(glint_renderer_layers(renderer, &frame->layers, &error), GLINT_OK);
    }
    const glint_kernel_kind general = glint_general_kernel_of(&frame->plan);
    const glint_kernel_kind kind = glint_renderer_kernels(renderer);
    assert_int_equal(kind, kernels == GLINT_KERNELS_SPECIAL ? GLINT_KERNEL_SPECIAL : general);
    glint_renderer_free(renderer);
}

// Weights that were cut off are sums of floats, by pixels or by lanes: they may differ by rounding.
static void assert_alike(double a, double b)
{
    const double rounding = 256 * 0x1p-24; // of the sums over a tile
    assert_true(fabs(a - b) <= rounding * fmax(a, b));
}

static void assert_same_counts(const glint_frame_report *a, const glint_frame_report *b)
{
    const glint_truncation *t = &a->truncation, *u = &b->truncation;
    assert_memory_equal(&a->rays, &b->rays, sizeof a->rays);
    assert_int_equal(a->deepest, b->deepest);
    assert_int_equal(t->media_overflows, u->media_overflows);
    assert_alike(t->by_depth, u->by_depth);
    assert_alike(t->by_min_weight, u->by_min_weight);
    assert_alike(t->by_stack, u->by_stack);
    assert_alike(t->rms, u->rms);
}

static void assert_same_layers(const glint_layers *a, const glint_layers *b, size_t pixels)
{
    assert_int_equal(a->count, b->count);
    if (a->count > 0) {
        assert_memory_equal(a->values, b->values, pixels * a->count * sizeof *a->values);
    }
}

// Returns the general kernel that was compared; GLINT_KERNEL_SPECIAL: none serves the plan.
static glint_kernel_kind compare(const glint_scene *scene, const glint_settings *settings,
                                 const char *what)
{
    test_frame frames[2] = {0};
    render_by(GLINT_KERNELS_SPECIAL, scene, *settings, what, &frames[0]);
    const glint_kernel_kind kind = glint_general_kernel_of(&frames[0].plan);
    if (kind == GLINT_KERNEL_SPECIAL) {
        print_error("%s: no general kernel\n", what);
    } else {
        render_by(GLINT_KERNELS_GENERAL, scene, *settings, what, &frames[1]);
        const size_t different = test_count_different(&frames[0].image, &frames[1].image);
        if (different != 0) {
            print_error("%s, %s: %zu pixels differ\n", what, glint_kernel_kind_name(kind),
                        different);
        }
        assert_int_equal(different, 0);
        assert_same_counts(&frames[0].report, &frames[1].report);
        assert_same_layers(&frames[0].layers, &frames[1].layers,
                           (size_t)settings->width * (size_t)settings->height);
    }
    test_frame_free(&frames[0]);
    test_frame_free(&frames[1]);
    return kind;
}

static glint_settings small_frame(void)
{
    glint_settings settings = glint_settings_default;
    settings.width = 85;
    settings.height = 47;
    return settings;
}

// ---- Scenes of scenes/, and settings -----------------------------------------------------------

static void with_defaults(glint_settings *s)
{
    (void)s;
}

static void with_several_samples(glint_settings *s)
{
    s->samples_per_axis = 7; // 49 × (1/49) is not 1 in float
    s->width = 29;
    s->height = 17;
}

static void without_background(glint_settings *s)
{
    s->transparent = true;
}

static void turned(glint_settings *s)
{
    s->env_rotate = 33;
}

static void through_levels(glint_settings *s)
{
    s->filter = GLINT_FILTER_MIP;
}

static void by_harmonics(glint_settings *s)
{
    s->irradiance = GLINT_IRRADIANCE_SH;
}

static void smooth(glint_settings *s)
{
    s->roughness = GLINT_ROUGHNESS_SMOOTH;
}

static void without_fresnel(glint_settings *s)
{
    s->fresnel = GLINT_FRESNEL_NONE;
}

static void without_lights(glint_settings *s)
{
    s->lights = GLINT_LIGHTS_NONE;
}

static void at_one_surface(glint_settings *s)
{
    s->depth = 1;
}

static void with_float_texels(glint_settings *s)
{
    s->texels = GLINT_TEXELS_FLOAT;
}

static void with_squares(glint_settings *s)
{
    s->truncation_squares = true;
    s->depth = 3;
}

static void with_layers(glint_settings *s)
{
    s->aovs = GLINT_AOV_ALL;
}

static void as_a_list(glint_settings *s)
{
    static uint32_t pixels[3][GLINT_LIST_COLUMNS];
    for (uint32_t i = 0; i < 3 * GLINT_LIST_COLUMNS; i++) {
        pixels[i / GLINT_LIST_COLUMNS][i % GLINT_LIST_COLUMNS] = i * 83;
    }
    s->list = &pixels[0][0];
    s->list_rows = 3;
}

static void in_double(glint_settings *s)
{
    s->precision = GLINT_PRECISION_DOUBLE;
}

typedef struct comparison {
    const char *scene;
    void (*set)(glint_settings *settings);
    glint_kernel_kind kind;
    bool is_slow; // only with GLINT_TEST_ROUNDS
} comparison;

static const comparison comparisons[] = {
    {"mirror_sphere", with_defaults, GLINT_KERNEL_MIRRORS, false},
    {"axes", with_several_samples, GLINT_KERNEL_MIRRORS, false},
    {"gallery", with_defaults, GLINT_KERNEL_PATHS, false},
    {"glass_slab", with_several_samples, GLINT_KERNEL_PATHS, false},
    {"textures", without_background, GLINT_KERNEL_EVERYTHING, false},
    {"lights", turned, GLINT_KERNEL_EVERYTHING, false},
    {"wine", with_defaults, GLINT_KERNEL_EVERYTHING, false},
    {"water", with_defaults, GLINT_KERNEL_EVERYTHING, false},
    {"materials", through_levels, GLINT_KERNEL_EVERYTHING, false},
    {"lights", with_layers, GLINT_KERNEL_EVERYTHING, false},
    {"gallery", as_a_list, GLINT_KERNEL_PATHS, false},
    {"mirror_sphere", as_a_list, GLINT_KERNEL_MIRRORS, true},
    {"textures", as_a_list, GLINT_KERNEL_EVERYTHING, true},
    {"glass_sphere", with_layers, GLINT_KERNEL_EVERYTHING, true},
    {"materials", by_harmonics, GLINT_KERNEL_EVERYTHING, true},
    {"materials", smooth, GLINT_KERNEL_PATHS, true},
    {"gallery", without_fresnel, GLINT_KERNEL_PATHS, true},
    {"lights", without_lights, GLINT_KERNEL_PATHS, true},
    {"gallery", at_one_surface, GLINT_KERNEL_PATHS, true},
    {"mirror_sphere", with_float_texels, GLINT_KERNEL_MIRRORS, true},
    {"nested_glass", with_float_texels, GLINT_KERNEL_PATHS, true},
    {"facing_mirrors", with_squares, GLINT_KERNEL_PATHS, true},
    {"mirror_sphere", in_double, GLINT_KERNEL_MIRRORS, true},
    {"gallery", in_double, GLINT_KERNEL_PATHS, true},
    {"water", in_double, GLINT_KERNEL_EVERYTHING, true},
    {"absorption_box", with_defaults, GLINT_KERNEL_PATHS, true},
    {"axes", with_defaults, GLINT_KERNEL_MIRRORS, true},
    {"clockwork", with_defaults, GLINT_KERNEL_PATHS, true},
    {"facing_mirrors", with_defaults, GLINT_KERNEL_PATHS, true},
    {"glass_slab", with_defaults, GLINT_KERNEL_PATHS, true},
    {"glass_sphere", with_defaults, GLINT_KERNEL_PATHS, true},
    {"lecture_example_2", with_defaults, GLINT_KERNEL_PATHS, true},
    {"lights", with_defaults, GLINT_KERNEL_EVERYTHING, true},
    {"materials", with_defaults, GLINT_KERNEL_PATHS, true},
    {"nested_glass", with_defaults, GLINT_KERNEL_PATHS, true},
    {"orthographic", with_defaults, GLINT_KERNEL_PATHS, true},
    {"prism", with_defaults, GLINT_KERNEL_PATHS, true},
    {"shot", with_defaults, GLINT_KERNEL_PATHS, true},
    {"textures", with_defaults, GLINT_KERNEL_EVERYTHING, true},
    {"thin_wall", with_defaults, GLINT_KERNEL_PATHS, true},
    {"worm", with_defaults, GLINT_KERNEL_PATHS, true},
};

static const char *rounds(void)
{
    return getenv("GLINT_TEST_ROUNDS");
}

static void general_kernels_have_the_bits_of_special_ones(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof comparisons / sizeof *comparisons; i++) {
        const comparison *c = &comparisons[i];
        if (c->is_slow && rounds() == NULL) {
            continue;
        }
        glint_scene scene = {0};
        glint_settings settings = small_frame();
        c->set(&settings);
        test_scene_load(c->scene, &scene);
        assert_int_equal(compare(&scene, &settings, c->scene), c->kind);
        glint_scene_free(&scene);
    }
}

static void an_empty_scene_has_a_general_kernel(void **state)
{
    (void)state;
    glint_scene scene = {0};
    test_scene_load("mirror_sphere", &scene);
    scene.triangle_count = 0;
    for (size_t i = 0; i < scene.instance_count; i++) {
        scene.instances[i].triangle_count = 0;
    }
    const glint_settings settings = small_frame();
    assert_int_equal(compare(&scene, &settings, "nothing"), GLINT_KERNEL_MIRRORS);
    glint_scene_free(&scene);
}

// ---- Lobes by chance ---------------------------------------------------------------------------

static float any(glint_random *random)
{
    return (float)glint_random_number(random);
}

static bool one_in(glint_random *random, int n)
{
    return glint_random_number(random) * n < 1;
}

static void fill_color(glint_random *random, float color[3])
{
    for (int c = 0; c < 3; c++) {
        color[c] = any(random);
    }
}

// Gives a material some lobes, each of the kinds in `kinds` with a chance of a half.
static void add_lobes(glint_random *random, unsigned kinds, glint_material *m)
{
    unsigned lobes = 0;
    for (int k = 0; k < 16; k++) {
        lobes |= one_in(random, 2) ? 1u << k : 0;
    }
    lobes &= kinds;
    m->clearcoat = lobes & 1 ? any(random) : 0;
    m->clearcoat_roughness = lobes & 2 ? any(random) : 0;
    m->iridescence = lobes & 4 ? any(random) : 0;
    m->iridescence_ior = 1.3F;
    m->iridescence_thickness[1] = 200 + 400 * any(random);
    if (lobes & 8) {
        m->specular = any(random);
        fill_color(random, m->specular_color);
    }
    if (lobes & 16) {
        fill_color(random, m->sheen_color);
        m->sheen_roughness = any(random);
    }
    if (lobes & 32) {
        m->diffuse_transmission = any(random);
        fill_color(random, m->diffuse_transmission_color);
    }
    if (lobes & 64) {
        m->roughness = any(random);
    }
    if (lobes & 128) {
        m->transmission = any(random);
    }
    if (lobes & 256) {
        m->dispersion = any(random);
    }
    if (lobes & 512) {
        m->alpha_mode = one_in(random, 2) ? GLINT_ALPHA_BLEND : GLINT_ALPHA_MASK;
        m->alpha = any(random);
        m->alpha_cutoff = 0.5F;
    }
    if (lobes & 1024) {
        m->anisotropy = any(random);
        m->anisotropy_rotation = any(random);
    }
    if (lobes & 2048) {
        m->metallic = any(random);
    }
    if (lobes & 4096) {
        fill_color(random, m->emission);
    }
}

static void any_lobes_have_the_bits_of_special_kernels(void **state)
{
    (void)state;
    static const char *const scenes[] = {"textures", "materials", "lights", "gallery", "wine"};
    const int count = rounds() != NULL ? atoi(rounds()) : 4;
    glint_random random = {2026};
    for (int i = 0; i < count; i++) {
        glint_scene scene = {0};
        glint_settings settings = small_frame();
        settings.facets = 4;
        test_scene_load(scenes[i % 5], &scene);
        const unsigned kinds = (unsigned)(glint_random_number(&random) * 8192);
        for (size_t k = 0; k < scene.material_count; k++) {
            add_lobes(&random, kinds, &scene.materials[k]);
        }
        settings.transparent = one_in(&random, 4);
        settings.filter = one_in(&random, 4) ? GLINT_FILTER_MIP : GLINT_FILTER_BILINEAR;
        settings.roughness = one_in(&random, 4) ? GLINT_ROUGHNESS_SMOOTH : GLINT_ROUGHNESS_FAST;
        settings.scattering = one_in(&random, 2);
        char what[64];
        snprintf(what, sizeof what, "round %d: %s with lobes %x", i, scenes[i % 5], kinds);
        assert_int_not_equal(compare(&scene, &settings, what), GLINT_KERNEL_SPECIAL);
        glint_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(general_kernels_have_the_bits_of_special_ones),
        cmocka_unit_test(an_empty_scene_has_a_general_kernel),
        cmocka_unit_test(any_lobes_have_the_bits_of_special_kernels),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
