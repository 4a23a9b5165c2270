// Tests each texture slot of a material, and colours and alpha of vertices. A texture of one value
// must act as a factor of this value. Bent normals and layers of planes have closed forms. Also
// tests the substitutes for unreadable textures.
#include "scene/material/material_override.h"
#include "support/bridge.h"
#include "support/by_corner.h"
#include "support/gltf_text.h"
#include "support/render.h"
#include "support/scratch.h"
#include "support/textured_plane.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- Slots --------------------------------------------------------------------------------------

static void write_texel(const char *name, int r, int g, int b, int a)
{
    const unsigned char texel[1][4] = {
        {(unsigned char)r, (unsigned char)g, (unsigned char)b, (unsigned char)a}};
    write_codes(name, (const int[]){1, 1}, texel);
}

typedef struct slot_case {
    const char *textured, *plain; // members of the material
} slot_case;

#define TEXTURE "{\"index\":0}"
// The texel is (51, 102, 204, 255): data 0.2, 0.4, 0.8; colour 0.0331, 0.1329, 0.6038.
#define COLOR "0.033104766570885055,0.13286832155381798,0.603827338855338"

static const slot_case slots[] = {
    {"\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorTexture\":" TEXTURE "}",
     "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[" COLOR ",1]}"},
    {"\"pbrMetallicRoughness\":{\"roughnessFactor\":0,\"metallicRoughnessTexture\":" TEXTURE "}",
     "\"pbrMetallicRoughness\":{\"roughnessFactor\":0,\"metallicFactor\":0.8}"},
    {"\"emissiveFactor\":[1,0.5,1],\"emissiveTexture\":" TEXTURE,
     "\"emissiveFactor\":[0.033104766570885055,0.06643416077690899,0.603827338855338]"},
    {"\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"occlusionTexture\":{\"index\":0,"
     "\"strength\":0.5}",
     "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[0.6,0.6,0.6,1]}"},
    {"\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extras\":{\"glint\":{\"mirror\":0.25}},"
     "\"occlusionTexture\":{\"index\":0,\"strength\":0.5}",
     "\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[0.6,0.6,0.6,1]},"
     "\"extras\":{\"glint\":{\"mirror\":0.25}}"},
    {"\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extensions\":{"
     "\"KHR_materials_transmission\":{\"transmissionFactor\":0.5,\"transmissionTexture\":" TEXTURE
     "}}",
     "\"pbrMetallicRoughness\":{\"metallicFactor\":0},\"extensions\":{"
     "\"KHR_materials_transmission\":{\"transmissionFactor\":0.1}}"},
    // An upright normal bends nothing.
    {"\"pbrMetallicRoughness\":{\"roughnessFactor\":0},\"normalTexture\":{\"index\":1,"
     "\"scale\":0}",
     "\"pbrMetallicRoughness\":{\"roughnessFactor\":0}"},
};

static double largest_difference(const test_frame *a, const test_frame *b, int pixels)
{
    double worst = 0;
    for (int i = 0; i < 4 * pixels; i++) {
        worst = fmax(worst, fabs(a->exact[i] - b->exact[i]) / (1 + fabs(b->exact[i])));
    }
    return worst;
}

static void render_plane(glint_scene scene, const glint_settings *settings, test_frame *frame)
{
    test_render(&scene, test_studio(), NULL, settings, frame);
    glint_scene_free(&scene);
}

static void a_texture_of_one_value_is_a_factor(void **state)
{
    write_texel("a.png", 51, 102, 204, 255);
    write_texel("b.png", 128, 128, 255, 255);
    const glint_settings settings = test_small_frame(2);
    for (size_t i = 0; i < sizeof slots / sizeof *slots; i++) {
        test_frame textured, plain;
        render_plane(
            textured_plane_load(*state,
                                MESH("") "\"images\":[{\"uri\":\"a.png\"},{\"uri\":\"b.png\"}],"
                                         "\"textures\":[{\"source\":0},{\"source\":1}],"
                                         "\"materials\":[{%s}]",
                                slots[i].textured),
            &settings, &textured);
        render_plane(textured_plane_load(*state, MESH("") "\"materials\":[{%s}]", slots[i].plain),
                     &settings, &plain);
        const double worst = largest_difference(&textured, &plain, 61 * 43);
        // Texels are rounded to 1/65535, factors to floats.
        if (!(worst < 2e-5)) {
            fail_msg("slot %zu: %g", i, worst);
        }
        test_frame_free(&textured);
        test_frame_free(&plain);
    }
}

static void colors_of_vertices_multiply_the_base_color(void **state)
{
    const glint_settings settings = test_small_frame(1);
    test_frame frame;
    render_plane(textured_plane_load(*state,
                                     MESH(",\"COLOR_0\":5") "\"materials\":[{" UNLIT
                                                            ",\"pbrMetallicRoughness\":{"
                                                            "\"baseColorFactor\":[1,0.5,1,1]}}]"),
                 &settings, &frame);
    for (int i = 0; i < 61 * 43; i++) {
        meeting m;
        if (textured_plane_meet(&settings, i, &m)) {
            const double far = (2 - m.at[1]) / 16; // 0 in front
            const double expected[3] = {1 - far / 2, 0.25 + far / 4, 0.25};
            for (int k = 0; k < 3; k++) {
                assert_true(fabs(frame.exact[4 * i + k] - expected[k]) < 2e-6);
            }
        }
    }
    test_frame_free(&frame);
}

// ---- Normals ------------------------------------------------------------------------------------

// The direction in a mirror whose normal a normal texture bends by (x, y).
static void bent_normals_turn_reflections(void **state)
{
    write_texel("n.png", 178, 89, 230, 255); // x = 0.396, y = −0.302, z = 0.804
    const double raw[3] = {2 * 178 / 255.0 - 1, 2 * 89 / 255.0 - 1, 2 * 230 / 255.0 - 1};
    glint_environment directions;
    bridge_direction_environment(32, &directions);
    // Tangents of the file; computed tangents.
    static const char *const tangents[] = {",\"TANGENT\":4", ""};
    for (int from_file = 0; from_file < 2; from_file++) {
        glint_scene scene = textured_plane_load(
            *state,
            "\"meshes\":[{\"primitives\":[{\"indices\":6,\"material\":0,\"attributes\":{"
            "\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2%s}}]}],\"images\":[{\"uri\":\"n.png\"}],"
            "\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":{"
            "\"roughnessFactor\":0},\"normalTexture\":{\"index\":0,\"scale\":0.5}}]",
            tangents[from_file]);
        glint_settings settings = test_small_frame(1);
        test_frame frame;
        test_render(&scene, &directions, NULL, &settings, &frame);
        // Tangent +x, bitangent in the direction of falling v: −z, normal +y.
        const double length = sqrt(raw[0] * raw[0] / 4 + raw[1] * raw[1] / 4 + raw[2] * raw[2]);
        const double n[3] = {raw[0] / 2 / length, raw[2] / length, -raw[1] / 2 / length};
        int compared = 0;
        for (int i = 0; i < 61 * 43; i++) {
            meeting m;
            if (!textured_plane_meet(&settings, i, &m)) {
                continue;
            }
            const double v[3] = {-m.at[0] / m.length, 1.5 / m.length, (3 - m.at[1]) / m.length};
            const double along = v[0] * n[0] + v[1] * n[1] + v[2] * n[2];
            double r[3];
            for (int k = 0; k < 3; k++) {
                r[k] = 2 * along * n[k] - v[k];
            }
            if (along < 0 || r[1] < 0) {
                continue; // skip folded directions, which tests/test_frame.c tests
            }
            for (int k = 0; k < 3; k++) {
                // Within the angular resolution of 32 texels a face.
                assert_true(fabs(frame.exact[4 * i + k] - (0.5 + 0.5 * r[k])) < 2e-3);
            }
            compared++;
        }
        assert_true(compared > 500);
        test_frame_free(&frame);
        glint_scene_free(&scene);
    }
    glint_environment_free(&directions);
}

// ---- Alpha --------------------------------------------------------------------------------------

// A second, glowing plane slightly below the first. The first is partly transparent.
#define TWO_PLANES(material)                                                                       \
    "\"meshes\":[{\"primitives\":[{\"indices\":6,\"material\":0,\"attributes\":{\"POSITION\":0,"   \
    "\"TEXCOORD_0\":2}}]},{\"primitives\":[{\"indices\":6,\"material\":1,\"attributes\":{"         \
    "\"POSITION\":0}}]}],\"materials\":[{" material "},{" UNLIT                                    \
    ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0.25,1,1]}}]"

static glint_scene load_two(const char *folder, const char *material, bool with_second)
{
    char rest[6000];
    snprintf(rest, sizeof rest, PLANE TWO_PLANES("%s"), material);
    char *nodes = strstr(rest, "\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":[{\"mesh\":0},");
    assert_non_null(nodes);
    char tail[6000];
    snprintf(tail, sizeof tail, "%s", strstr(nodes, "{\"camera\":0"));
    sprintf(nodes, "\"scenes\":[{\"nodes\":[0,1%s]}],\"nodes\":[{\"mesh\":0},",
            with_second ? ",2" : "");
    char *end = strstr(tail, "}],");
    assert_non_null(end);
    const size_t used = strlen(rest);
    snprintf(rest + used, sizeof rest - used, "%.*s},{\"mesh\":1,\"translation\":[0,-0.25,0]}%s",
             (int)(end - tail), tail, end + 1);
    return load_rest(folder, &the_plane, sizeof the_plane, rest);
}

typedef struct alpha_case {
    const char *material;
    double share; // share of the first plane, unlit (1, 0.5, 0)
} alpha_case;

#define RED(alpha) UNLIT ",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,0," alpha "]}"

static const alpha_case alphas[] = {
    {RED("0.25"), 1},
    {RED("0.25") ",\"alphaMode\":\"BLEND\"", 0.25},
    {RED("0") ",\"alphaMode\":\"BLEND\"", 0},
    {RED("0.25") ",\"alphaMode\":\"MASK\"", 0},
    {RED("0.5") ",\"alphaMode\":\"MASK\"", 1},
    {RED("0.25") ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0.2", 1},
    {RED("1") ",\"alphaMode\":\"MASK\",\"alphaCutoff\":1.5", 0},
};

// A near pixel, which shows both planes.
enum { NEAR_PIXEL = 61 * 33 + 30 };

static void what_is_there_in_part_lets_light_pass(void **state)
{
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        for (int depth = 1; depth < 3; depth++) {
            const glint_settings settings = test_small_frame(depth);
            test_frame frame;
            render_plane(load_two(*state, alphas[i].material, true), &settings, &frame);
            const double share = alphas[i].share;
            const double expected[3] = {share, share * 0.5 + (1 - share) * 0.25, 1 - share};
            for (int k = 0; k < 3; k++) {
                if (!(fabs(frame.exact[4 * NEAR_PIXEL + k] - expected[k]) < 1e-6)) {
                    fail_msg("case %zu, depth %d: %g, not %g", i, depth,
                             frame.exact[4 * NEAR_PIXEL + k], expected[k]);
                }
            }
            test_frame_free(&frame);
        }
    }
}

static void alpha_is_kept_where_the_background_is_left_out(void **state)
{
    for (size_t i = 0; i < sizeof alphas / sizeof *alphas; i++) {
        glint_settings settings = test_small_frame(0);
        settings.transparent = true;
        test_frame frame;
        render_plane(load_two(*state, alphas[i].material, false), &settings, &frame);
        const double share = alphas[i].share;
        const double expected[4] = {share, share * 0.5, 0, share};
        for (int k = 0; k < 4; k++) {
            if (!(fabs(frame.exact[4 * NEAR_PIXEL + k] - expected[k]) < 1e-6)) {
                fail_msg("case %zu, channel %d: %g, not %g", i, k, frame.exact[4 * NEAR_PIXEL + k],
                         expected[k]);
            }
        }
        assert_true(frame.exact[3] == 0); // above the horizon
        test_frame_free(&frame);
    }
}

// ---- Refusals and substitutes -------------------------------------------------------------------

static void unreadable_textures_leave_their_factors(void **state)
{
    scratch_write("broken.png", "\x89PNG\r\n\x1a\nnothing more", -1);
    static const char *const images[] = {"broken.png", "missing.png"};
    const glint_settings settings = test_small_frame(1);
    test_frame plain;
    render_plane(textured_plane_load(*state, MESH("") "\"materials\":[{\"pbrMetallicRoughness\":{"
                                                      "\"baseColorFactor\":[0.25,0.5,1,1]}}]"),
                 &settings, &plain);
    for (int i = 0; i < 2; i++) {
        char rest[6000];
        snprintf(rest, sizeof rest,
                 PLANE MESH("") "\"images\":[{\"uri\":\"%s\"}],\"textures\":[{\"source\":0}],"
                                "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                                "{\"index\":0},\"baseColorFactor\":[0.25,0.5,1,1]}}]",
                 images[i]);
        char *text = gltf_text(&the_plane, sizeof the_plane, rest);
        glint_scene scene;
        glint_warnings warnings = {0};
        glint_error error = {0};
        assert_int_equal(load_text(*state, text, &scene, &warnings, &error), GLINT_OK);
        assert_int_equal(warnings.count, 1);
        assert_true(any_warning_has(&warnings, ": images[0] \""));
        assert_true(any_warning_has(&warnings, "; the maps that need it are left out"));
        test_frame frame;
        render_plane(scene, &settings, &frame);
        assert_memory_equal(frame.exact, plain.exact, 4 * 61 * 43 * sizeof *frame.exact);
        test_frame_free(&frame);
        glint_warnings_free(&warnings);
        free(text);
    }
    test_frame_free(&plain);
}

// KHR_materials_ior: an index of 0 is infinite, so that smooth paint is a white mirror. glint takes
// 1e5 for it: of the light 2 (c + 1/c)/1e5 passes, where c is the cosine to the normal.
static void an_index_of_zero_reflects_all(void **state)
{
    const glint_settings settings = test_small_frame(1);
    test_frame paint, mirror;
    render_plane(textured_plane_load(
                     *state,
                     MESH("") "\"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,"
                              "\"roughnessFactor\":0,\"baseColorFactor\":[0,0,0,1]},"
                              "\"extensions\":{\"KHR_materials_ior\":{\"ior\":0}}}]"),
                 &settings, &paint);
    render_plane(textured_plane_load(*state, MESH("") "\"materials\":[{\"pbrMetallicRoughness\":{"
                                                      "\"roughnessFactor\":0}}]"),
                 &settings, &mirror);
    double least = 1;
    for (int i = 0; i < 61 * 43; i++) {
        meeting m;
        least = textured_plane_meet(&settings, i, &m) ? fmin(least, m.cosine) : least;
    }
    assert_true(least > 0 && least < 1);
    const double passes = 2 * (least + 1 / least) / 1e5;
    assert_true(largest_difference(&paint, &mirror, 61 * 43) < passes + 1e-6); // and rounding
    test_frame_free(&paint);
    test_frame_free(&mirror);
}

// Loads the plane's file again, with an override.
static glint_scene load_overridden(const char *path, const char *text, glint_warnings *warnings)
{
    glint_material_overrides overrides = {0};
    const glint_option option = {.name = "material"};
    assert_int_equal(glint_material_override_parse(&option, text, &overrides, NULL), GLINT_OK);
    glint_scene scene;
    assert_int_equal(glint_scene_load(path, &(glint_scene_options){.overrides = &overrides}, &scene,
                                      warnings, NULL),
                     GLINT_OK);
    return scene;
}

#define COLORED(material)                                                                          \
    "{\"indices\":6,\"material\":" #material ",\"attributes\":{\"POSITION\":0,\"COLOR_0\":5}}"

// Both materials have vertex colours. A white preset removes the colours of its material. A preset
// with the file's colour keeps them.
static void presets_take_colors_of_vertices_away_or_keep_them(void **state)
{
    glint_scene plain =
        textured_plane_load(*state, "\"meshes\":[{\"primitives\":[" COLORED(0) "," COLORED(
                                        1) "]}],\"materials\":[{\"name\":\"a\"},{\"name\":\"b\"}]");
    glint_scene glass = load_overridden(plain.path, "a=glass", NULL);
    glint_scene paint = load_overridden(plain.path, "a=paint", NULL);
    assert_int_equal(plain.triangle_count, 4);
    assert_int_equal(glint_attributes_stride(&plain.attribute_set), 4);
    scene_by_corner(&plain);
    scene_by_corner(&glass);
    scene_by_corner(&paint);
    for (int i = 0; i < 2 * 3 * 4; i++) {
        assert_true(glass.attributes[i] == 1);
        assert_true(paint.attributes[i] == plain.attributes[i]);
        assert_true(glass.attributes[24 + i] == plain.attributes[24 + i]);
    }
    assert_false(glass.materials[0].has_vertex_colors);
    assert_true(paint.materials[0].has_vertex_colors && glass.materials[1].has_vertex_colors);
    glint_scene_free(&plain);
    glint_scene_free(&glass);
    glint_scene_free(&paint);
}

static void presets_stay_where_the_color_texture_cannot_be_read(void **state)
{
    glint_scene plain = textured_plane_load(
        *state, MESH("") "\"images\":[{\"uri\":\"none.png\"}],\"textures\":[{\"source\":0}],"
                         "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                         "{\"index\":0},\"baseColorFactor\":[1,0.25,0.5,1]}}]");
    glint_warnings warnings = {0};
    glint_scene metal = load_overridden(plain.path, "*=metal", &warnings);
    assert_true(any_warning_has(&warnings, "; the maps that need it are left out"));
    assert_true(metal.materials[0].metallic == 1 && metal.materials[0].roughness == 0);
    assert_true(metal.materials[0].base_color[1] == 0.25F);
    assert_int_equal(metal.materials[0].textures[GLINT_TEXTURE_BASE_COLOR].image, 0);
    glint_warnings_free(&warnings);
    glint_scene_free(&plain);
    glint_scene_free(&metal);
}

static void images_of_replaced_materials_are_not_read(void **state)
{
    write_texel("a.png", 51, 102, 204, 255);
    glint_scene plain = textured_plane_load(
        *state, MESH("") "\"images\":[{\"uri\":\"a.png\"}],\"textures\":[{\"source\":0}],"
                         "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                         "{\"index\":0}}}]");
    assert_int_equal(plain.textures->count, 1);
    glint_material_overrides overrides = {0};
    const glint_option option = {.name = "material"};
    assert_int_equal(glint_material_override_parse(&option, "*=glass", &overrides, NULL), GLINT_OK);
    glint_scene replaced;
    assert_int_equal(glint_scene_load(plain.path, &(glint_scene_options){.overrides = &overrides},
                                      &replaced, NULL, NULL),
                     GLINT_OK);
    assert_null(replaced.textures);
    assert_null(replaced.attributes);
    glint_scene_free(&plain);
    glint_scene_free(&replaced);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_setup, scratch_teardown)
    const struct CMUnitTest tests[] = {
        TEST(a_texture_of_one_value_is_a_factor),
        TEST(colors_of_vertices_multiply_the_base_color),
        TEST(bent_normals_turn_reflections),
        TEST(what_is_there_in_part_lets_light_pass),
        TEST(alpha_is_kept_where_the_background_is_left_out),
        TEST(unreadable_textures_leave_their_factors),
        TEST(an_index_of_zero_reflects_all),
        TEST(images_of_replaced_materials_are_not_read),
        TEST(presets_take_colors_of_vertices_away_or_keep_them),
        TEST(presets_stay_where_the_color_texture_cannot_be_read),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
