// Tests layers: their names, the owners of their numbers, and the independence of other results.
// test_aov.c tests their values.
#include "render/owners.h"
#include "render/settings_table.h"
#include "report/frame/manifest.h"

#include "support/bridge.h"
#include "support/render.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// ---- Names -------------------------------------------------------------------------------------

// The old name is a separate layer with its old channel. Only an explicit request gives it.
static void depth_is_an_old_name_of_surfaces(void **state)
{
    (void)state;
    glint_settings settings = test_small_frame(0);
    char text[GLINT_SETTING_TEXT];
    assert_int_equal(glint_aovs_parse("aov", "all", &settings.aovs, NULL), GLINT_OK);
    assert_int_equal(settings.aovs, GLINT_AOV_ALL);
    assert_int_equal(glint_aovs_parse("aov", "z,depth,Surfaces", &settings.aovs, NULL), GLINT_OK);
    glint_aovs_print(settings.aovs, text, sizeof text);
    assert_string_equal(text, "surfaces,Z,depth");
    test_frame frame;
    test_render_named("glass_slab", &settings, &frame);
    assert_int_equal(frame.layers.count, 3);
    assert_string_equal(frame.layers.channels[0].name, "surfaces.count");
    assert_string_equal(frame.layers.channels[1].name, "Z");
    assert_string_equal(frame.layers.channels[2].name, "depth.surfaces");
    assert_memory_equal(frame.layers.channels[0].values, frame.layers.channels[2].values,
                        (size_t)(settings.width * settings.height) * sizeof(float));
    test_frame_free(&frame);
    glint_error error = {0};
    assert_int_equal(glint_aovs_parse("aov", "dist", &settings.aovs, &error), GLINT_USAGE);
    assert_non_null(strstr(error.message, "surfaces"));
    assert_null(strstr(error.message, "depth"));
}

// ---- Numbers -----------------------------------------------------------------------------------

static void the_array_of_channels_has_room_for_all(void **state)
{
    (void)state;
    assert_int_equal(glint_layers_channels(GLINT_AOV_VALID), GLINT_AOV_CHANNELS);
}

static void triangles_find_their_owners(void **state)
{
    (void)state;
    glint_material materials[] = {{.index = 7}, {.index = 2}};
    glint_instance instances[] = {{.node_index = 5, .triangle_count = 3, .material = 1},
                                  {.node_index = 0, .first_triangle = 3, .triangle_count = 1},
                                  {.node_index = 9, .first_triangle = 4, .triangle_count = 9}};
    const glint_scene scene = {
        .materials = materials, .material_count = 2, .instances = instances, .instance_count = 3};
    glint_owners owners = {0};
    assert_int_equal(glint_owner_of(&owners, 0).node, -1); // no triangle
    assert_int_equal(glint_owners_set(&owners, &scene, NULL), GLINT_OK);
    static const struct {
        int triangle, node, material;
    } cases[] = {{-1, -1, -1}, {0, 5, 2}, {2, 5, 2}, {3, 0, 7}, {4, 9, 7}, {12, 9, 7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_equal(glint_owner_of(&owners, cases[i].triangle).node, cases[i].node);
        assert_int_equal(glint_owner_of(&owners, cases[i].triangle).material, cases[i].material);
    }
    glint_owners_free(&owners);
}

// Manifests use the file's numbers. Names may be missing, duplicate, or invalid UTF-8.
static void manifests_name_what_is_there(void **state)
{
    (void)state;
    static char gem[] = "gem \"1\"", latin[] = "caf\xe9";
    glint_material materials[] = {{.index = 2, .name = latin}, {.index = 4}};
    glint_instance instances[] = {{.node_index = 9, .node = gem},
                                  {.node_index = 9, .node = gem},
                                  {.node_index = 12, .node = gem},
                                  {.node_index = 3}};
    const glint_scene scene = {
        .materials = materials, .material_count = 2, .instances = instances, .instance_count = 4};
    char *text;
    assert_int_equal(glint_manifest_of_objects(&scene, &text, NULL), GLINT_OK);
    assert_string_equal(text, "{\"9\":\"gem \\\"1\\\"\",\"12\":\"gem \\\"1\\\"\",\"3\":\"\"}");
    free(text);
    assert_int_equal(glint_manifest_of_materials(&scene, &text, NULL), GLINT_OK);
    assert_string_equal(text, "{\"2\":\"caf?\",\"4\":\"\"}");
    free(text);
    assert_int_equal(glint_manifest_of_objects(&(glint_scene){0}, &text, NULL), GLINT_OK);
    assert_string_equal(text, "{}");
    free(text);
}

// ---- Unchanged results -------------------------------------------------------------------------

// Where a depth is proved, layers without longer paths use the short way, too.
static void layers_of_surfaces_keep_the_bits_of_what_is_proved(void **state)
{
    (void)state;
    glint_settings settings = test_small_frame(0);
    test_frame plain, with;
    test_render_named("mirror_sphere", &settings, &plain);
    settings.aovs = GLINT_AOV_ALL & ~GLINT_AOV_OF_PATHS;
    test_render_named("mirror_sphere", &settings, &with);
    assert_int_equal(test_count_different(&plain.image, &with.image), 0);
    assert_memory_equal(&plain.report.rays, &with.report.rays, sizeof with.report.rays);
    test_frame_free(&plain);
    test_frame_free(&with);
}

static void a_renderer_without_layers_gives_none(void **state)
{
    (void)state;
    glint_scene scene = {0};
    glint_environment environment;
    bridge_direction_environment(16, &environment);
    const glint_settings settings = test_small_frame(1);
    const glint_renderer_inputs inputs = {.device = test_device(),
                                          .scene = &scene,
                                          .environment = &environment,
                                          .settings = &settings};
    glint_renderer *renderer;
    assert_int_equal(glint_renderer_create(&inputs, &renderer, NULL), GLINT_OK);
    glint_layers layers;
    assert_int_equal(glint_renderer_layers(renderer, &layers, NULL), GLINT_USAGE);
    assert_int_equal(layers.count, 0);
    assert_null(layers.values);
    glint_renderer_free(renderer);
    glint_environment_free(&environment);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depth_is_an_old_name_of_surfaces),
        cmocka_unit_test(the_array_of_channels_has_room_for_all),
        cmocka_unit_test(triangles_find_their_owners),
        cmocka_unit_test(manifests_name_what_is_there),
        cmocka_unit_test(layers_of_surfaces_keep_the_bits_of_what_is_proved),
        cmocka_unit_test(a_renderer_without_layers_gives_none),
    };
    return cmocka_run_group_tests(tests, NULL, test_close_device);
}
