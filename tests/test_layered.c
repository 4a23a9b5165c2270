// Tests glTF's extensions for layered surfaces against the oracle: specular, clear coats,
// dispersion, thin films, anisotropy, sheen, diffuse transmission.
#include "support/bridge.h"
#include "support/judged.h"
#include "support/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void add_specular(const void *kind, glint_material *m)
{
    (void)kind;
    m->specular = 0.6F;
    m->specular_color[0] = 40; // above the limit
    m->specular_color[1] = 0.5F;
}

// KHR_materials_specular: on smooth and rough paint, beside metal, on glass, and under lights. The
// oracle's quadrature is plain; the lobes have their own error (test_rough.c).
static void specular_weighs_and_colours_what_paint_and_glass_reflect(void **state)
{
    (void)state;
    static const struct {
        const char *scene;
        float roughness, metallic;
        int strata;
        double allowed;
    } kinds[] = {
        {"mirror_sphere", 0, 0, 0, 1e-6},      {"mirror_sphere", 0.3F, 0, 0, 0.004},
        {"mirror_sphere", 0.8F, 0, 0, 0.004},  {"mirror_sphere", 0.8F, 0.5F, 0, 0.004},
        {"lights", 0.4F, -1, 0, 0.004},        {"glass_sphere", 0, -1, 0, 1e-5},
        {"nested_glass", 0, -1, 0, 1e-5},      {"thin_wall", 0, -1, 0, 3e-5},
        {"glass_sphere", 0.3F, -1, 24, 0.016},
    };
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const judged j = {.scene = kinds[i].scene,
                          .environment = &environment,
                          .settings = judged_frame(16, 12, 3),
                          .feature = GLINT_FEATURE_SPECULAR,
                          .strata = kinds[i].strata,
                          .roughness = kinds[i].roughness,
                          .metallic = kinds[i].metallic,
                          .alpha = 1,
                          .change = add_specular};
        const double error = judge(&j);
        print_message("specular, %s, roughness %g: %.7f\n", j.scene, (double)j.roughness, error);
        assert_true(error <= kinds[i].allowed);
    }
    glint_environment_free(&environment);
}

// These slots use the base colour's texture, if there is one.
static void borrow_textures(glint_material *m, const glint_texture_slot *slots, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        m->textures[slots[i]] = m->textures[GLINT_TEXTURE_BASE_COLOR];
    }
}

typedef struct coated {
    const char *scene;
    float roughness, metallic, coat, coat_roughness, alpha;
    int strata;
    double allowed;
} coated;

static void add_coat(const void *kind, glint_material *m)
{
    m->clearcoat = ((const coated *)kind)->coat;
    m->clearcoat_roughness = ((const coated *)kind)->coat_roughness;
    borrow_textures(
        m, (const glint_texture_slot[]){GLINT_TEXTURE_CLEARCOAT, GLINT_TEXTURE_CLEARCOAT_ROUGHNESS},
        2);
    m->textures[GLINT_TEXTURE_CLEARCOAT_NORMAL] = m->textures[GLINT_TEXTURE_NORMAL];
}

// Clear coats on metal, paint, glass and partly transparent surfaces, with lights.
static void clear_coats_are_what_the_oracle_sees(void **state)
{
    (void)state;
    static const coated kinds[] = {
        {"mirror_sphere", 0, 1, 0.7F, 0, 1, 0, 1e-6},  // one branch
        {"mirror_sphere", 0, 0, 1, 0, 1, 0, 1e-6},     // of smooth paint, too
        {"mirror_sphere", 1, 0, 1, 0, 1, 0, 0.001},    // matte paint has no branch
        {"mirror_sphere", 0.4F, 1, 1, 0, 1, 0, 0.004}, // two branches
        {"mirror_sphere", 0.4F, 0.5F, 1, 0.2F, 1, 0, 0.004},
        {"mirror_sphere", 0, 1, 1, 0.4F, 1, 0, 0.004},
        {"mirror_sphere", 0, 1, 1, 0.8F, 1, 0, 0.004},  // the lobe of the coat takes no path
        {"mirror_sphere", 1, 0, 1, 0.05F, 1, 0, 0.004}, // a mirror shows a share of the coat
        {"facing_mirrors", 0.3F, 1, 1, 0, 1, 0, 0.004},
        {"lights", 0.4F, -1, 1, 0.3F, 1, 0, 0.004},
        {"textures", 0.4F, -1, 1, 0.5F, 1, 0, 0.004},
        {"glass_sphere", 0, -1, 1, 0, 1, 0, 1e-5},
        {"nested_glass", 0, -1, 0.5F, 0, 1, 0, 1e-5},
        {"thin_wall", 0, -1, 1, 0, 1, 0, 3e-5},
        {"thin_wall", 0, -1, 1, 0.2F, 0.6F, 0, 0.004},
        {"glass_sphere", 0.3F, -1, 1, 0, 1, 24, 0.016},
    };
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        judged j = {.scene = kinds[i].scene,
                    .environment = &environment,
                    .settings = judged_frame(16, 12, 3),
                    .feature = GLINT_FEATURE_CLEARCOAT,
                    .strata = kinds[i].strata,
                    .roughness = kinds[i].roughness,
                    .metallic = kinds[i].metallic,
                    .alpha = kinds[i].alpha,
                    .change = add_coat,
                    .kind = &kinds[i]};
        j.settings.min_weight = 0; // the oracle follows a coat by itself
        const double error = judge(&j);
        print_message("coat %g of roughness %g, %s, roughness %g: %.7f\n", (double)kinds[i].coat,
                      (double)kinds[i].coat_roughness, j.scene, (double)j.roughness, error);
        assert_true(error <= kinds[i].allowed);
    }
    glint_environment_free(&environment);
}

typedef struct dispersed {
    const char *scene;
    float dispersion, roughness, alpha;
    int wavelengths, depth, samples, strata;
    glint_precision precision;
    double allowed;
} dispersed;

static void add_dispersion(const void *kind, glint_material *m)
{
    m->dispersion = ((const dispersed *)kind)->dispersion;
}

// KHR_materials_dispersion: single, nested, absorbing and rough glass. Thin walls and metal beside
// it have no dispersion. Tests few and many wavelengths, and more than one sample.
static void solids_disperse_light_as_the_oracle_does(void **state)
{
    (void)state;
    static const dispersed kinds[] = {
        {"glass_sphere", 1, 0, 1, 3, 1, 1, 0, GLINT_PRECISION_FLOAT, 1e-5},
        {"glass_sphere", 1, 0, 1, 3, 4, 1, 0, GLINT_PRECISION_FLOAT, 1e-5},
        {"glass_sphere", 5, 0, 1, 16, 4, 1, 0, GLINT_PRECISION_DOUBLE, 1e-7},
        {"prism", 0.4F, 0, 1, 5, 5, 2, 0, GLINT_PRECISION_DOUBLE, 1e-7},
        {"nested_glass", 2, 0, 1, 3, 5, 1, 0, GLINT_PRECISION_DOUBLE, 1e-7},
        {"absorption_box", 30, 0, 1, 2, 4, 1, 0, GLINT_PRECISION_FLOAT, 1e-5}, // index 1 for red
        {"gallery", 1, 0, 0.5F, 3, 4, 1, 0, GLINT_PRECISION_DOUBLE, 1e-4},
        {"glass_sphere", 2, 0.3F, 1, 3, 2, 1, 24, GLINT_PRECISION_FLOAT, 0.016},
    };
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const dispersed *kind = &kinds[i];
        judged j = {.scene = kind->scene,
                    .environment = &environment,
                    .settings = judged_frame(16, 12, kind->depth),
                    .feature = GLINT_FEATURE_DISPERSION,
                    .strata = kind->strata,
                    .roughness = kind->roughness,
                    .metallic = -1,
                    .alpha = kind->alpha,
                    .change = add_dispersion,
                    .kind = kind};
        j.settings.samples_per_axis = kind->samples;
        j.settings.wavelengths = kind->wavelengths;
        j.settings.precision = kind->precision;
        j.settings.min_weight = 0;
        const double error = judge(&j);
        print_message("dispersion %g, %d wavelengths, %s, roughness %g, depth %d: %.9f\n",
                      (double)kind->dispersion, kind->wavelengths, kind->scene,
                      (double)kind->roughness, kind->depth, error);
        assert_true(error <= kind->allowed);
    }
    glint_environment_free(&environment);
}

typedef struct filmed {
    const char *scene;
    float roughness, metallic, film, ior, thickness, specular;
    int strata;
    glint_precision precision;
    double allowed;
} filmed;

static void add_film(const void *kind, glint_material *m)
{
    const filmed *f = kind;
    m->iridescence = f->film;
    m->iridescence_ior = f->ior;
    m->iridescence_thickness[1] = f->thickness;
    m->specular = f->specular;
    borrow_textures(m,
                    (const glint_texture_slot[]){GLINT_TEXTURE_IRIDESCENCE,
                                                 GLINT_TEXTURE_IRIDESCENCE_THICKNESS},
                    2);
    if (m->metallic == 1) {
        m->base_color[0] = 0.9F;
        m->base_color[1] = 0.6F;
        m->base_color[2] = 0.2F;
    }
}

// KHR_materials_iridescence: on smooth metal and paint, on glass from both sides, on thin walls, on
// rough surfaces. The device sums 8 interreflections in the film. On rough surfaces it uses the
// film's reflectance at the angle of view.
static void films_colour_what_the_oracle_sees(void **state)
{
    (void)state;
    static const filmed kinds[] = {
        {"mirror_sphere", 0, 1, 1, 1.3F, 400, 1, 0, GLINT_PRECISION_FLOAT, 1e-5},
        {"mirror_sphere", 0, 1, 1, 2.2F, 250, 1, 0, GLINT_PRECISION_DOUBLE, 1e-5},
        {"mirror_sphere", 0, 0, 1, 1.8F, 600, 1, 0, GLINT_PRECISION_FLOAT, 1e-5},
        {"mirror_sphere", 0, 0.5F, 0.7F, 1.4F, 0, 0.5F, 0, GLINT_PRECISION_FLOAT, 1e-4},
        {"glass_sphere", 0, -1, 1, 1.3F, 500, 1, 0, GLINT_PRECISION_FLOAT, 1e-4},
        {"glass_sphere", 0, -1, 1, 1.9F, 300, 1, 0, GLINT_PRECISION_DOUBLE, 1e-4},
        {"nested_glass", 0, -1, 1, 1.6F, 300, 1, 0, GLINT_PRECISION_FLOAT, 1e-4},
        {"thin_wall", 0, -1, 1, 1.4F, 350, 0.6F, 0, GLINT_PRECISION_FLOAT, 1e-4},
        {"textures", 0, 1, 1, 1.5F, 400, 1, 0, GLINT_PRECISION_FLOAT, 0.003},
        {"mirror_sphere", 0.2F, 1, 1, 1.3F, 400, 1, 0, GLINT_PRECISION_FLOAT, 0.015},
        {"mirror_sphere", 0.5F, 1, 1, 1.8F, 300, 1, 0, GLINT_PRECISION_FLOAT, 0.03},
        {"mirror_sphere", 0.4F, 0, 1, 1.8F, 300, 1, 0, GLINT_PRECISION_FLOAT, 0.008},
        {"glass_sphere", 0.3F, -1, 1, 1.8F, 300, 1, 24, GLINT_PRECISION_FLOAT, 0.016},
    };
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const filmed *kind = &kinds[i];
        judged j = {.scene = kind->scene,
                    .environment = &environment,
                    .settings = judged_frame(16, 12, 3),
                    .feature = GLINT_FEATURE_IRIDESCENCE,
                    .strata = kind->strata,
                    .roughness = kind->roughness,
                    .metallic = kind->metallic,
                    .alpha = 1,
                    .change = add_film,
                    .kind = kind};
        j.settings.precision = kind->precision;
        const double error = judge(&j);
        print_message("film %g of %g, %g nm, %s, roughness %g: %.7f\n", (double)kind->film,
                      (double)kind->ior, (double)kind->thickness, kind->scene,
                      (double)kind->roughness, error);
        assert_true(error <= kind->allowed);
    }
    glint_environment_free(&environment);
}

typedef struct brushed {
    const char *scene;
    glint_feature feature;
    float roughness, metallic, strength, rotation;
    glint_precision precision;
    double allowed;
} brushed;

static void add_brush(const void *kind, glint_material *m)
{
    m->anisotropy = ((const brushed *)kind)->strength;
    m->anisotropy_rotation = ((const brushed *)kind)->rotation;
    borrow_textures(m, (const glint_texture_slot[]){GLINT_TEXTURE_ANISOTROPY}, 1);
}

// KHR_materials_anisotropy, with a file whose surfaces have tangents. A file without tangents must
// show no anisotropy.
static void brushed_surfaces_are_what_the_oracle_sees(void **state)
{
    (void)state;
    static const brushed kinds[] = {
        {"textures", GLINT_FEATURE_BRUSHED, 0.3F, -1, 0.5F, 0, GLINT_PRECISION_FLOAT, 0.003},
        {"textures", GLINT_FEATURE_BRUSHED, 0.5F, 1, 0.7F, 1, GLINT_PRECISION_FLOAT, 0.004},
        {"textures", GLINT_FEATURE_BRUSHED, 0.5F, 0, 1, -0.5F, GLINT_PRECISION_DOUBLE, 0.003},
        {"mirror_sphere", GLINT_FEATURE_ROUGH, 0.4F, 1, 0.8F, 2, GLINT_PRECISION_FLOAT,
         0.003}, // without tangents
    };
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const brushed *kind = &kinds[i];
        judged j = {.scene = kind->scene,
                    .environment = &environment,
                    .settings = judged_frame(16, 12, 2),
                    .feature = kind->feature,
                    .roughness = kind->roughness,
                    .metallic = kind->metallic,
                    .alpha = 1,
                    .change = add_brush,
                    .kind = kind};
        j.settings.precision = kind->precision;
        const double error = judge(&j);
        print_message("anisotropy %g, %s, roughness %g, metallic %g: %.7f\n",
                      (double)kind->strength, kind->scene, (double)kind->roughness,
                      (double)kind->metallic, error);
        assert_true(error <= kind->allowed);
    }
    glint_environment_free(&environment);
}

typedef struct velvet {
    const char *scene;
    float roughness, metallic, color, sheen_roughness, coat;
    double allowed;
} velvet;

static void add_sheen(const void *kind, glint_material *m)
{
    const velvet *v = kind;
    m->sheen_color[0] = v->color;
    m->sheen_color[1] = 0.5F * v->color;
    m->sheen_roughness = v->sheen_roughness;
    m->clearcoat = v->coat;
    borrow_textures(
        m, (const glint_texture_slot[]){GLINT_TEXTURE_SHEEN_COLOR, GLINT_TEXTURE_SHEEN_ROUGHNESS},
        2);
}

// KHR_materials_sheen: on matte and smooth paint, on metal, below a coat, under lights. Glass has
// no sheen.
static void sheen_is_what_the_oracle_sees(void **state)
{
    (void)state;
    static const velvet kinds[] = {
        {"mirror_sphere", 1, 0, 1, 1, 0, 0.001},       {"mirror_sphere", 1, 0, 1, 0.5F, 0, 0.001},
        {"mirror_sphere", 1, 0, 1, 0.3F, 0, 0.001},    {"mirror_sphere", 1, 0, 1, 0.15F, 0, 0.001},
        {"mirror_sphere", 1, 0, 1, 0, 0, 0.002}, // same result as for NARROW
        {"mirror_sphere", 0, 0, 0.4F, 0.4F, 0, 0.001}, {"mirror_sphere", 0, 1, 1, 0.6F, 0, 0.001},
        {"mirror_sphere", 1, 0, 1, 0.4F, 1, 0.001},    {"lights", 0.4F, -1, 0.7F, 0.3F, 0, 0.001},
        {"gallery", 0, -1, 1, 0.5F, 0, 0.001},         {"textures", 1, 0, 1, 0.7F, 0, 0.001},
    };
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const velvet *kind = &kinds[i];
        const judged j = {.scene = kind->scene,
                          .environment = &environment,
                          .settings = judged_frame(16, 12, 3),
                          .feature = GLINT_FEATURE_SHEEN,
                          .roughness = kind->roughness,
                          .metallic = kind->metallic,
                          .alpha = 1,
                          .change = add_sheen,
                          .kind = kind};
        const double error = judge(&j);
        print_message("sheen %g of roughness %g, %s: %.7f\n", (double)kind->color,
                      (double)kind->sheen_roughness, kind->scene, error);
        assert_true(error <= kind->allowed);
    }
    glint_environment_free(&environment);
}

typedef struct paper {
    const char *scene;
    float roughness, share, coat;
    double allowed;
} paper;

static void make_translucent(const void *kind, glint_material *m)
{
    m->diffuse_transmission = ((const paper *)kind)->share;
    m->diffuse_transmission_color[2] = 0.25F;
    m->clearcoat = ((const paper *)kind)->coat;
    borrow_textures(m,
                    (const glint_texture_slot[]){GLINT_TEXTURE_DIFFUSE_TRANSMISSION,
                                                 GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR},
                    2);
}

// KHR_materials_diffuse_transmission: the environment and lights light paint from behind. The paint
// is matte, smooth, rough or below a coat.
static void paint_is_lit_from_behind_as_the_oracle_says(void **state)
{
    (void)state;
    static const paper kinds[] = {
        {"mirror_sphere", 1, 1, 0, 2e-4},     {"mirror_sphere", 0, 0.4F, 0, 1e-5},
        {"mirror_sphere", 1, 0.7F, 1, 0.001}, {"lights", 1, 1, 0, 0.001},
        {"lights", 0, 0.6F, 0, 1e-4},         {"gallery", 0, 0.5F, 0, 1e-4},
        {"textures", 0, 1, 0, 0.001},
    };
    glint_environment environment;
    bridge_direction_environment(64, &environment);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const paper *kind = &kinds[i];
        const judged j = {.scene = kind->scene,
                          .environment = &environment,
                          .settings = judged_frame(16, 12, 3),
                          .feature = GLINT_FEATURE_DIFFUSE_TRANSMISSION,
                          .roughness = kind->roughness,
                          .metallic = 0,
                          .alpha = 1,
                          .change = make_translucent,
                          .kind = kind};
        const double error = judge(&j);
        print_message("diffuse transmission %g, %s, roughness %g: %.7f\n", (double)kind->share,
                      kind->scene, (double)kind->roughness, error);
        assert_true(error <= kind->allowed);
    }
    glint_environment_free(&environment);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(specular_weighs_and_colours_what_paint_and_glass_reflect),
        cmocka_unit_test(clear_coats_are_what_the_oracle_sees),
        cmocka_unit_test(solids_disperse_light_as_the_oracle_does),
        cmocka_unit_test(brushed_surfaces_are_what_the_oracle_sees),
        cmocka_unit_test(sheen_is_what_the_oracle_sees),
        cmocka_unit_test(paint_is_lit_from_behind_as_the_oracle_says),
        cmocka_unit_test(films_colour_what_the_oracle_sees),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
