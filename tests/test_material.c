// Tests which lobes a material has, by its factors.
#include "scene/material/material.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define NO_BLEND GLINT_MATERIAL_SPECULAR, .mirror = (-1)
#define WHITE .base_color = {1, 1, 1}
#define RED .base_color = {1, 0, 0}
#define SOLID NO_BLEND, .transmission = 1, .thickness = 1
#define CLEAR .attenuation_distance = INFINITY, .attenuation_color = {1, 1, 1}
#define HAS_SOLID .glass = true, .solid = true
#define EVERYTHING                                                                                 \
    RED, CLEAR, .metallic = 0.5F, .transmission = 0.5F, .thickness = 1, .emission = {1, 1, 1}

static const struct {
    const char *name;
    glint_material material;
    glint_lobes lobes;
} cases[] = {
    {"white metal", {NO_BLEND, WHITE, .metallic = 1}, {.metal = true}},
    {"rough metal",
     {NO_BLEND, WHITE, .metallic = 1, .roughness = 1},
     {.metal = true, .rough = true, .rough_path = true}},
    {"red metal", {NO_BLEND, RED, .metallic = 1}, {.metal = true, .tint = true}},
    {"metal that would be glass", {SOLID, WHITE, .metallic = 1}, {.metal = true}},
    {"matte paint", {NO_BLEND, RED, .roughness = 1}, {.paint = true, .rough = true}},
    {"smooth paint", {NO_BLEND}, {.paint = true, .gloss = true}},
    {"paint of NaN roughness", {NO_BLEND, .roughness = NAN}, {.paint = true, .gloss = true}},
    {"thickness alone", {NO_BLEND, .thickness = 1, .roughness = 1}, {.paint = true, .rough = true}},
    {"the least roughness",
     {NO_BLEND, .roughness = GLINT_ROUGHNESS_LEAST},
     {.paint = true, .rough = true, .rough_path = true}},
    {"the last roughness whose coat sees surfaces",
     {NO_BLEND, .roughness = 0.599F},
     {.paint = true, .rough = true, .rough_path = true}},
    {"the first whose coat sees none",
     {NO_BLEND, .roughness = GLINT_COAT_MATTE},
     {.paint = true, .rough = true}},
    {"less than the least roughness",
     {NO_BLEND, .roughness = 0.0099F},
     {.paint = true, .gloss = true}},
    {"a wall", {NO_BLEND, .transmission = 1}, {.glass = true, .thin = true}},
    {"the least rough wall",
     {NO_BLEND, .transmission = 1, .roughness = GLINT_ROUGHNESS_LEAST},
     {.glass = true, .thin = true, .facets = true}},
    {"brushed metal, however smooth it is across",
     {NO_BLEND, WHITE, .metallic = 1, .anisotropy = 0.5F},
     {.metal = true, .rough = true, .brushed = true, .rough_path = true}},
    {"glass, which is never brushed",
     {NO_BLEND, .transmission = 1, .anisotropy = 0.5F},
     {.glass = true, .thin = true}},
    {"paper",
     {NO_BLEND, .roughness = 1, .diffuse_transmission = 0.5F},
     {.paint = true, .translucent = true, .rough = true}},
    {"velvet",
     {NO_BLEND, .roughness = 1, .sheen_color = {0, 0, 0.5F}},
     {.paint = true, .rough = true, .sheen = true}},
    {"glass, which has no fibres",
     {NO_BLEND, .transmission = 1, .sheen_color = {1, 1, 1}},
     {.glass = true, .thin = true}},
    {"white metal below a film",
     {NO_BLEND, WHITE, .metallic = 1, .iridescence = 0.5F},
     {.metal = true, .tint = true, .iridescent = true}},
    {"a wall, which disperses no light",
     {NO_BLEND, .transmission = 1, .dispersion = 1},
     {.glass = true, .thin = true}},
    {"a solid that disperses light",
     {SOLID, CLEAR, .dispersion = 1},
     {.glass = true, .solid = true, .dispersion = true}},
    {"a rough wall that is paint in part, whose coat is its facets'",
     {NO_BLEND, .transmission = 0.5F, .roughness = 0.5F},
     {.glass = true, .thin = true, .facets = true, .paint = true, .gloss = true}},
    {"paint that reflects less",
     {.mirror = -1, RED, .specular = 0.5F, .specular_color = {1, 1, 1}},
     {.paint = true, .gloss = true, .specular = true}},
    {"a wall of coloured reflection",
     {.mirror = -1, .transmission = 1, .specular = 1, .specular_color = {1, 1, 0}},
     {.glass = true, .thin = true, .specular = true}},
    {"metal, of which specular says nothing",
     {.mirror = -1, WHITE, .metallic = 1, .specular = 0},
     {.metal = true}},
    {"a clear coat on matte paint",
     {NO_BLEND, RED, .roughness = 1, .clearcoat = 1},
     {.paint = true, .rough = true, .clearcoat = true}},
    {"a wide coat on metal",
     {NO_BLEND, WHITE, .metallic = 1, .clearcoat = 0.5F, .clearcoat_roughness = 0.9F},
     {.metal = true, .clearcoat = true, .rough_clearcoat = true}},
    {"no coat on what is unlit", {NO_BLEND, WHITE, .unlit = true, .clearcoat = 1}, {.unlit = true}},
    {"a clear solid", {SOLID, CLEAR}, {HAS_SOLID}},
    {"a solid that absorbs green",
     {SOLID, .attenuation_distance = 2, .attenuation_color = {1, 0.5F, 1}},
     {HAS_SOLID, .absorption = true}},
    {"a solid that absorbs nothing",
     {SOLID, .attenuation_distance = 2, .attenuation_color = {1, 1, 1}},
     {HAS_SOLID}},
    {"a solid that absorbs at no distance", {SOLID, .attenuation_distance = INFINITY}, {HAS_SOLID}},
    {"a mixture of all",
     {NO_BLEND, EVERYTHING},
     {HAS_SOLID, .metal = true, .tint = true, .paint = true, .gloss = true, .emission = true}},
    {"the least shares",
     {NO_BLEND, WHITE, .metallic = 1e-45F, .transmission = 1e-45F, .roughness = 1},
     {.metal = true, .glass = true, .thin = true, .facets = true, .paint = true, .gloss = true}},
    {"the blend", {.mirror = 0.5F}, {.blend = true, .blend_mirror = true}},
    {"the blend without a mirror", {.mirror = 0}, {.blend = true}},
    {"the blend hides all but emission",
     {EVERYTHING, .mirror = 1},
     {.blend = true, .blend_mirror = true, .emission = true}},
    {"unlit hides all", {NO_BLEND, EVERYTHING, .unlit = true}, {.unlit = true}},
    {"unlit hides the blend", {.unlit = true, .mirror = 0.5F}, {.unlit = true}},
};

static void materials_have_the_lobes_that_their_factors_ask_for(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const glint_lobes lobes = glint_material_lobes(&cases[i].material);
        if (memcmp(&lobes, &cases[i].lobes, sizeof lobes) != 0) { // only flags, no padding
            fail_msg("%s", cases[i].name);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_have_the_lobes_that_their_factors_ask_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
