// Tests overrides of materials (--material) and variants of materials (--variant).
#include "scene/material/material_override.h"

#include "support/gltf_text.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const glint_option option = {.kind = GLINT_OPTION_CUSTOM, .name = "material"};

#define FILE_MATERIAL GLINT_MATERIAL_CLEAR, .mirror = (-1)

// Materials as in a file.
static void file_materials(glint_material materials[4])
{
    static char body[] = "body", gem[] = "gem", three[] = "3";
    const glint_material made[] = {
        {FILE_MATERIAL, .name = body, .index = 0, .base_color = {0.5F, 0.25F, 1}, .roughness = 1},
        {FILE_MATERIAL, .name = gem, .index = 1, .base_color = {1, 0, 0}, .metallic = 1,
         .emission = {1, 2, 3}},
        {FILE_MATERIAL, .name = three, .index = 2, .unlit = true},
        {FILE_MATERIAL, .index = 3, .metallic = 1, .roughness = 1},
    };
    memcpy(materials, made, sizeof made);
}

// Parses the texts, up to NULL, and applies them to the materials.
static glint_status override(const char *const *texts, glint_material materials[4],
                             glint_error *error)
{
    glint_material_overrides overrides = {0};
    file_materials(materials);
    for (; *texts != NULL; texts++) {
        TRY(glint_material_override_parse(&option, *texts, &overrides, error));
    }
    TRY(glint_material_overrides_resolve(&overrides, materials, 4, error));
    for (int i = 0; i < 4; i++) {
        glint_material_overrides_apply(&overrides, &materials[i]);
    }
    return GLINT_OK;
}

#define OVERRIDE(materials, ...)                                                                   \
    assert_int_equal(override((const char *const[]){__VA_ARGS__, NULL}, materials, NULL), GLINT_OK)

static void assert_color(const float color[3], double r, double g, double b)
{
    assert_true(color[0] == (float)r && color[1] == (float)g && color[2] == (float)b);
}

// ---- Results of overrides ----------------------------------------------------------------------

static void a_preset_replaces_the_material_whole(void **state)
{
    (void)state;
    glint_material m[4];
    OVERRIDE(m, "gem=glass,ior=2.42");
    const glint_lobes gem = glint_material_lobes(&m[1]);
    assert_true(gem.glass && gem.solid && !gem.metal && !gem.paint && !gem.emission);
    assert_true(m[1].ior == 2.42F && m[1].roughness == 0);
    assert_color(m[1].base_color, 1, 1, 1);
    assert_string_equal(m[1].name, "gem");
    assert_int_equal(m[1].index, 1);
    assert_true(m[0].roughness == 1 && m[0].transmission == 0); // the others are unchanged
}

static void each_preset_is_what_it_is_called(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        glint_lobes lobes;
        float ior, red; // of the material with the colour (0.5, 0.25, 1)
    } presets[] = {
        {"body=mirror", {.metal = true}, 1.5F, 1},
        {"body=metal", {.metal = true, .tint = true}, 1.5F, 0.5F},
        {"body=glass", {.glass = true, .solid = true}, 1.5F, 1},
        {"body=thin-glass", {.glass = true, .thin = true}, 1.5F, 1},
        {"body=diamond", {.glass = true, .solid = true}, 2.417F, 1},
        {"body=water", {.glass = true, .solid = true}, 1.333F, 1},
        {"body=paint", {.paint = true, .rough = true}, 1.5F, 0.5F},
        {"body=glossy-paint", {.paint = true, .gloss = true}, 1.5F, 0.5F},
        {"body=unlit", {.unlit = true}, 1.5F, 0.5F},
    };
    char all[512] = "";
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++) {
        glint_material m[4];
        OVERRIDE(m, presets[i].text);
        const glint_lobes lobes = glint_material_lobes(&m[0]);
        assert_memory_equal(&lobes, &presets[i].lobes, sizeof lobes);
        assert_true(m[0].ior == presets[i].ior && m[0].base_color[0] == presets[i].red);
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i > 0 ? ", " : "",
                 presets[i].text + strlen("body="));
    }
    assert_string_equal(all, GLINT_MATERIAL_PRESETS); // the list in the help text
}

static void values_alone_change_what_the_file_says(void **state)
{
    (void)state;
    glint_material m[4];
    OVERRIDE(m, "body=color=1,0.5,0,roughness=0,emission=10,0,1e3");
    assert_color(m[0].base_color, 1, 0.5, 0);
    assert_color(m[0].emission, 10, 0, 1000);
    assert_true(m[0].roughness == 0 && m[0].metallic == 0 && m[0].ior == 1.5F);
    OVERRIDE(m, "body=transmission=0.5,thickness=0.1,ior=1.3,attenuation-color=0.5,0.5,1,"
                "attenuation-distance=2,metallic=0.25");
    assert_true(m[0].transmission == 0.5F && m[0].thickness == 0.1F && m[0].ior == 1.3F &&
                m[0].attenuation_distance == 2 && m[0].metallic == 0.25F);
    assert_color(m[0].attenuation_color, 0.5, 0.5, 1);
    assert_color(m[0].base_color, 0.5, 0.25, 1);
}

static void every_value_is_in_the_help(void **state)
{
    (void)state;
    static const char *const values[] = {
        "body=paint,color=0,0,0",
        "body=paint,metallic=1",
        "body=paint,roughness=0",
        "body=paint,emission=1,1,1",
        "body=paint,transmission=1",
        "body=glass,ior=2",
        "body=glass,thickness=0",
        "body=glass,attenuation-color=0,0,0,attenuation-distance=1",
        "body=glass,attenuation-distance=1,attenuation-color=0,0,0",
        "body=glass,dispersion=0.36"};
    char all[512] = "";
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        glint_material m[4];
        OVERRIDE(m, values[i]);
        const char *name = strchr(values[i], ',') + 1;
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%.*s", i > 0 ? ", " : "",
                 (int)strcspn(name, "="), name);
    }
    assert_string_equal(all, GLINT_MATERIAL_VALUES);
}

static void overrides_follow_each_other(void **state)
{
    (void)state;
    glint_material m[4];
    OVERRIDE(m, "*=paint", "gem=glass", "gem=ior=1.8");
    for (int i = 0; i < 4; i++) {
        assert_true(i == 1 ? m[i].transmission == 1 && m[i].ior == 1.8F
                           : m[i].transmission == 0 && m[i].roughness == 1 && !m[i].unlit);
    }
    OVERRIDE(m, "gem=glass", "*=paint");
    assert_true(m[1].transmission == 0);
}

static void an_index_is_a_name_where_no_name_is_it(void **state)
{
    (void)state;
    glint_material m[4];
    OVERRIDE(m, "3=glass"); // the material "3", which has index 2
    assert_true(m[2].transmission == 1 && m[3].transmission == 0);
    OVERRIDE(m, "1=glass");
    assert_true(m[1].transmission == 1 && m[0].transmission == 0);
}

// ---- Refusals ----------------------------------------------------------------------------------

static void what_makes_no_sense_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *said;
    } bad[] = {
        {"gem", "a material and what it becomes are expected"},
        {"gem=", "a material and what it becomes are expected"},
        {"=glass", "a material and what it becomes are expected"},
        {"gem=glas", "there is no 'glas' (did you mean glass?)"},
        {"gem=frobnicate", "there is no 'frobnicate' (there are mirror, metal"},
        {"gem=colour=1,1,1", "there is no 'colour' (did you mean color?)"},
        {"gem=glass,", "there is no ''"},
        {"gem=,glass", "there is no ''"},
        {"gem=glass,mirror", "'mirror' is a second preset (give one)"},
        {"gem=ior=2,glass", "'glass' replaces the values before it (put it first)"},
        {"gem=glass,ior", "an index of refraction of 1 or more is expected as in ior=…"},
        {"gem=glass,ior=2,ior=3", "ior is given twice"},
        {"gem=glass,ior=0.9", "ior: an index of refraction of 1 or more is expected"},
        {"gem=glass,ior=nan", "ior: an index"},
        {"gem=glass,ior=inf", "ior: an index"},
        {"gem=glass,ior=1e39", "ior: an index"},
        {"gem=glass,ior=", "ior: an index"},
        {"gem=glass,ior=2x", "ior: an index"},
        {"gem=glass,thickness=-1", "thickness: 0, for a thin wall, or more is expected"},
        {"gem=metal,color=1,1", "color: R,G,B from 0 to 1, linear is expected"},
        {"gem=metal,color=1,1,1,1", "color: R,G,B"},
        {"gem=metal,color=1,1,1.01", "color: R,G,B"},
        {"gem=metal,color=1,,1", "color: R,G,B"},
        {"gem=metal,color=1,1,", "color: R,G,B"},
        {"gem=metal,roughness=-0.1", "roughness: a number from 0 to 1 is expected"},
        {"gem=paint,emission=-1,0,0", "emission: R,G,B of 0 or more is expected"},
        {"gem=glass,attenuation-distance=0", "attenuation-distance: metres, more than 0"},
        {"gem=glass,attenuation-distance=1e-60", "attenuation-distance: metres, more than 0"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        glint_material_overrides overrides = {0};
        glint_error error = {0};
        assert_int_equal(glint_material_override_parse(&option, bad[i].text, &overrides, &error),
                         GLINT_USAGE);
        if (strstr(error.message, bad[i].said) == NULL) {
            fail_msg("%s: %s", bad[i].text, error.message);
        }
        assert_int_equal(overrides.count, 0);
    }
}

static void what_changes_nothing_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *said;
    } bad[] = {
        {"gem=ior=2.42", "ior changes nothing there (glass and glossy paint have it)"},
        {"body=ior=2", "ior changes nothing there"}, // the surface is rough
        {"gem=mirror,transmission=1", "transmission changes nothing there (glass and paint"},
        {"gem=paint,thickness=1", "thickness changes nothing there (glass has it)"},
        {"gem=thin-glass,attenuation-color=1,0,0",
         "attenuation-color changes nothing there (solid"},
        {"gem=glass,attenuation-distance=1", "attenuation-distance changes nothing there (solid"},
        {"3=roughness=0.5", "roughness changes nothing there (metal, glass and paint have it)"},
        {"3=emission=1,1,1", "emission changes nothing there (unlit materials have none)"},
        {"Gem=glass", "there is no material \"Gem\" (did you mean \"gem\"?)"},
        {"ruby=glass",
         "there is no material \"ruby\" (there is 0 \"body\", 1 \"gem\", 2 \"3\", 3)"},
        {"4=glass", "there is no material \"4\" (there is 0"},
        {"-1=glass", "there is no material \"-1\""},
        {"+1=glass", "there is no material \"+1\""},
        {"99999999999999999999=glass", "there is no material"},
        {"4294967297=glass", "there is no material"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        glint_material m[4];
        glint_error error = {0};
        assert_int_equal(override((const char *const[]){bad[i].text, NULL}, m, &error),
                         GLINT_BAD_INPUT);
        if (strstr(error.message, bad[i].said) == NULL) {
            fail_msg("%s: %s", bad[i].text, error.message);
        }
    }
    glint_material m[4];
    OVERRIDE(m, "*=ior=2", "body=roughness=0"); // both overrides together have an effect
}

static void there_is_room_for_so_many(void **state)
{
    (void)state;
    glint_material_overrides overrides = {0};
    glint_error error = {0};
    for (int i = 0; i < GLINT_MATERIAL_OVERRIDES_MAX; i++) {
        assert_int_equal(glint_material_override_parse(&option, "a=glass", &overrides, NULL),
                         GLINT_OK);
    }
    assert_int_equal(glint_material_override_parse(&option, "a=glass", &overrides, &error),
                     GLINT_USAGE);
    assert_non_null(strstr(error.message, "64 times at most"));
}

// ---- Files -------------------------------------------------------------------------------------

// Two tetrahedra with the materials red and green, which swap in variants, and a third without a
// material.
#define MAPPING(material, variant) "{\"material\":" material ",\"variants\":[" variant "]}"
#define MAPPINGS(text) "\"extensions\":{\"KHR_materials_variants\":{\"mappings\":[" text "]}}"
#define VARIANTS(text) ",\"extensions\":{\"KHR_materials_variants\":{\"variants\":[" text "]}}"
#define PRIMITIVE(text) "{\"primitives\":[{" TETRAHEDRON_PRIMITIVE text "}]}"
#define MATERIALS                                                                                  \
    ",\"materials\":[{\"name\":\"red\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0,1]}}," \
    "{\"name\":\"green\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,1,0,1]}},"               \
    "{\"name\":\"unused\"}]"
#define MESHES(text)                                                                               \
    TETRAHEDRON_STORAGE ",\"meshes\":[" text "],\"nodes\":[{\"mesh\":0},{\"mesh\":1},"             \
                        "{\"mesh\":2}],\"scenes\":[{\"nodes\":[0,1,2]}]" MATERIALS
#define TWO_NAMES "{\"name\":\"day\"},{\"name\":\"night\"}"
#define WITH_VARIANTS                                                                              \
    MESHES(PRIMITIVE(",\"material\":0," MAPPINGS(MAPPING("1", "1"))) "," PRIMITIVE(                \
        ",\"material\":1," MAPPINGS(MAPPING("0", "0,1"))) "," PRIMITIVE(""))                       \
    VARIANTS(TWO_NAMES)                                                                            \
    ",\"extensionsUsed\":[\"KHR_materials_variants\"],"                                            \
    "\"extensionsRequired\":[\"KHR_materials_variants\"]"

static glint_status load(const char *folder, const char *rest, const glint_scene_options *options,
                         glint_scene *scene, glint_error *error)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, rest);
    const char *path = write_bytes(folder, "test.gltf", text, strlen(text));
    free(text);
    return glint_scene_load(path, options, scene, NULL, error);
}

// The materials of the three instances, in a variant.
static void assert_materials(const char *folder, const char *variant, const int wanted[3])
{
    glint_scene scene;
    const glint_scene_options options = {.variant = variant};
    assert_int_equal(load(folder, WITH_VARIANTS, &options, &scene, NULL), GLINT_OK);
    assert_int_equal(scene.instance_count, 3);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(scene.materials[scene.instances[i].material].index, wanted[i]);
    }
    assert_int_equal(scene.variant_count, 2);
    assert_string_equal(scene.variants[0], "day");
    assert_string_equal(scene.variants[1], "night");
    glint_scene_free(&scene);
}

static void a_variant_gives_primitives_their_materials(void **state)
{
    enum { RED, GREEN, UNUSED, DEFAULT };
    assert_materials(*state, NULL, (const int[]){RED, GREEN, DEFAULT});
    assert_materials(*state, "day", (const int[]){RED, RED, DEFAULT});
    assert_materials(*state, "night", (const int[]){GREEN, RED, DEFAULT});
    assert_materials(*state, "1", (const int[]){GREEN, RED, DEFAULT});
}

// What is wrong in a variant's materials is told of where a variant is chosen.
static void bad_mappings_are_left_out(void **state)
{
#define MAPPED(text) MESHES(PRIMITIVE("," text) "," PRIMITIVE("") "," PRIMITIVE(""))
    static const struct {
        const char *rest, *said;
    } bad[] = {
        {MAPPED(MAPPINGS(MAPPING("3", "0"))) VARIANTS(TWO_NAMES),
         "3: there is no such material (the file has 3 materials"},
        {MAPPED(MAPPINGS(MAPPING("-1", "0"))) VARIANTS(TWO_NAMES), "-1: there"},
        {MAPPED(MAPPINGS(MAPPING("0.5", "0"))) VARIANTS(TWO_NAMES), "0.5: there"},
        {MAPPED(MAPPINGS(MAPPING("0", "2"))) VARIANTS(TWO_NAMES),
         "2: there is no such variant (the file has 2 variants"},
        {MAPPED(MAPPINGS(MAPPING("0", "1e300"))) VARIANTS(TWO_NAMES), "1e+300: there is no such"},
        {MAPPED(MAPPINGS(MAPPING("0", "0") "," MAPPING("1", "1,0"))) VARIANTS(TWO_NAMES),
         "variant 0 has a material already"},
        {MAPPED(MAPPINGS("{\"variants\":[0]}")) VARIANTS(TWO_NAMES), "missing"},
        {MAPPED(MAPPINGS("{\"material\":0}")) VARIANTS(TWO_NAMES), "missing"},
        {MAPPED(MAPPINGS("7")) VARIANTS(TWO_NAMES), "7 stands where an object must"},
        {MAPPED("\"extensions\":{\"KHR_materials_variants\":{}}") VARIANTS(TWO_NAMES), "missing"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, bad[i].rest);
        const char *path = write_bytes(*state, "test.gltf", text, strlen(text));
        for (int chosen = 0; chosen < 2; chosen++) {
            glint_scene scene;
            glint_warnings warnings = {0};
            const glint_scene_options options = {.variant = chosen ? "day" : NULL};
            assert_int_equal(glint_scene_load(path, &options, &scene, &warnings, NULL), GLINT_OK);
            assert_int_equal(warnings.count, chosen);
            assert_true(!chosen || (any_warning_has(&warnings, "meshes[0].primitives[0]: ") &&
                                    any_warning_has(&warnings, bad[i].said) &&
                                    any_warning_has(&warnings, "; further materials of variants")));
            glint_warnings_free(&warnings);
            glint_scene_free(&scene);
        }
        free(text);
    }
}

// A file without variants that can be read is a file without variants.
static void bad_variants_are_none(void **state)
{
    static const struct {
        const char *rest;
        bool is_list;
    } lists[] = {
        {MAPPED("\"mode\":4") VARIANTS("{}"), true},
        {MAPPED("\"mode\":4") VARIANTS("{\"name\":1}"), true},
        {MAPPED("\"mode\":4") VARIANTS("7"), false},
        {MAPPED("\"mode\":4") ",\"extensions\":{\"KHR_materials_variants\":{}}", false},
        {MAPPED("\"mode\":4") ",\"extensions\":[]", false},
        {MAPPED(MAPPINGS(MAPPING("0", "0"))), false},
    };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        glint_scene scene;
        glint_error error = {0};
        assert_int_equal(load(*state, lists[i].rest, NULL, &scene, &error), GLINT_OK);
        assert_int_equal(scene.variant_count, lists[i].is_list);
        glint_scene_free(&scene);
        const glint_scene_options options = {.variant = "0"};
        const glint_status status = load(*state, lists[i].rest, &options, &scene, &error);
        assert_int_equal(status, lists[i].is_list ? GLINT_OK : GLINT_BAD_INPUT);
        assert_int_equal(strstr(error.message, "there is no material variant \"0\" (the file has "
                                               "none)") != NULL,
                         !lists[i].is_list);
        glint_scene_free(&scene);
    }
}

static void an_unknown_variant_is_refused_with_those_there_are(void **state)
{
    glint_scene scene;
    glint_error error = {0};
    glint_scene_options options = {.variant = "dusk"};
    assert_int_equal(load(*state, WITH_VARIANTS, &options, &scene, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "there is no material variant \"dusk\" (there is 0 "
                                          "\"day\", 1 \"night\")"));
    options.variant = "2";
    assert_int_equal(load(*state, WITH_VARIANTS, &options, &scene, &error), GLINT_BAD_INPUT);
    options.variant = "0";
    assert_int_equal(load(*state, MAPPED("\"mode\":4"), &options, &scene, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "\"0\" (the file has none)"));
}

// Names may refer to all materials of the file. Triangles may use other materials at another time,
// or in another variant.
static void overrides_know_materials_that_nothing_uses(void **state)
{
    glint_material_overrides overrides = {0};
    glint_material_override_parse(&option, "unused=glass", &overrides, NULL);
    glint_material_override_parse(&option, "green=mirror", &overrides, NULL);
    glint_material_override_parse(&option, "3=diamond", &overrides, NULL); // glTF's default
    const glint_scene_options options = {.overrides = &overrides, .variant = "night"};
    glint_scene scene;
    glint_warnings warnings = {0};
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, WITH_VARIANTS);
    const char *path = write_bytes(*state, "test.gltf", text, strlen(text));
    assert_int_equal(glint_scene_load(path, &options, &scene, &warnings, NULL), GLINT_OK);
    free(text);
    const glint_material *green = &scene.materials[scene.instances[0].material];
    const glint_material *plain = &scene.materials[scene.instances[2].material];
    assert_true(green->metallic == 1 && green->roughness == 0);
    assert_color(green->base_color, 1, 1, 1);
    assert_true(plain->ior == 2.417F);
    assert_true(any_warning_has(&warnings, "--material unused=glass: no triangle has this"));
    // No warning may mention the replaced material.
    assert_false(any_warning_has(&warnings, "the default material"));
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
}

// The source keeps its own copy of the command line's list.
static void every_scene_of_a_source_is_overridden(void **state)
{
    glint_material_overrides overrides = {0};
    glint_material_override_parse(&option, "red=glass", &overrides, NULL);
    glint_scene_source *source;
    const glint_scene_options options = {.overrides = &overrides};
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, WITH_VARIANTS);
    const char *path = write_bytes(*state, "test.gltf", text, strlen(text));
    free(text);
    assert_int_equal(glint_scene_open(path, &options, &source, NULL), GLINT_OK);
    overrides = (glint_material_overrides){0};
    for (int i = 0; i < 3; i++) {
        glint_scene scene;
        assert_int_equal(glint_scene_at(source, i, &scene, NULL, NULL), GLINT_OK);
        assert_true(scene.materials[scene.instances[0].material].transmission == 1);
        glint_scene_free(&scene);
    }
    glint_scene_close(source);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_preset_replaces_the_material_whole),
        cmocka_unit_test(each_preset_is_what_it_is_called),
        cmocka_unit_test(values_alone_change_what_the_file_says),
        cmocka_unit_test(every_value_is_in_the_help),
        cmocka_unit_test(overrides_follow_each_other),
        cmocka_unit_test(an_index_is_a_name_where_no_name_is_it),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(what_changes_nothing_is_refused),
        cmocka_unit_test(there_is_room_for_so_many),
        cmocka_unit_test(a_variant_gives_primitives_their_materials),
        cmocka_unit_test(bad_mappings_are_left_out),
        cmocka_unit_test(bad_variants_are_none),
        cmocka_unit_test(an_unknown_variant_is_refused_with_those_there_are),
        cmocka_unit_test(overrides_know_materials_that_nothing_uses),
        cmocka_unit_test(every_scene_of_a_source_is_overridden),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
