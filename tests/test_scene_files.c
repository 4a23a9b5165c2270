// Tests loaded scenes except for triangles: scenes, cameras, materials, warnings, sources of bytes,
// and models from elsewhere.
#include "scene/scene.h"

#include "scene/shape/topology.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static glint_vec3 world(const glint_scene *scene, const float *p)
{
    glint_vec3 stored = {p[0], p[1], p[2]};
    return glint_vec3_add(scene->origin, glint_vec3_scale(stored, scene->unit));
}

static glint_vec3 corner(const glint_scene *scene, size_t triangle, size_t c)
{
    return world(scene, glint_scene_position(scene, triangle, c));
}

static void assert_near3(glint_vec3 v, double x, double y, double z)
{
    if (!(fabs(v.x - x) <= 1e-6 && fabs(v.y - y) <= 1e-6 && fabs(v.z - z) <= 1e-6)) {
        fail_msg("(%g, %g, %g) is not (%g, %g, %g)", v.x, v.y, v.z, x, y, z);
    }
}

static void scenes_are_chosen_by_default_name_and_index(void **state)
{
    const char *rest =
        TETRAHEDRON ",\"nodes\":[{\"mesh\":0,\"name\":\"a\"},{\"mesh\":0,\"name\":"
                    "\"b\"},{\"mesh\":0,\"name\":\"c\"}],\"scenes\":[{\"nodes\":[0]},"
                    "{\"nodes\":[1],\"name\":\"second\"},{\"nodes\":[2]}]%s";
    const struct {
        const char *end, *name, *expected;
    } cases[] = {
        {"", NULL, "a"}, {",\"scene\":2", NULL, "c"}, {"", "second", "b"},
        {"", "2", "c"},  {",\"scene\":2", "0", "a"},
    };
    for (size_t i = 0; i < 5; i++) {
        char text[2048];
        snprintf(text, sizeof text, rest, cases[i].end);
        char *whole = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, text);
        glint_scene scene;
        glint_error error = {0};
        const glint_scene_options options = {.scene = cases[i].name}, third = {.scene = "third"};
        const char *path = write_bytes(*state, "test.gltf", whole, strlen(whole));
        assert_int_equal(glint_scene_load(path, &options, &scene, NULL, &error), GLINT_OK);
        assert_string_equal(scene.instances[0].node, cases[i].expected);
        glint_scene_free(&scene);
        assert_int_equal(glint_scene_load(path, &third, &scene, NULL, &error), GLINT_BAD_INPUT);
        assert_non_null(
            strstr(error.message, "there is no scene \"third\" (there is 0, 1 \"second"));
        assert_null(scene.positions);
        free(whole);
    }
}

static void a_file_without_scenes_shows_every_root(void **state)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron,
                           TETRAHEDRON ",\"nodes\":[{\"children\":[1]},{\"mesh\":0},{\"mesh\":0}]");
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    assert_int_equal(scene.instance_count, 2);
    assert_true(any_warning_has(&warnings, "scenes: missing, so that every root node is shown"));
    glint_scene_free(&scene);
    glint_warnings_free(&warnings);
    free(text);
}

static void cameras_come_depth_first_without_scale(void **state)
{
    glint_scene scene = load_tetrahedron(
        *state,
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,\"znear\":0.1},"
        "\"name\":\"lens\"},{\"type\":\"orthographic\",\"orthographic\":{\"xmag\":1,\"ymag\":-3,"
        "\"znear\":0,\"zfar\":9}}],\"nodes\":[{\"children\":[3,1],\"scale\":[2,3,-4]},{\"camera\":"
        "0},"
        "{\"camera\":1,\"name\":\"last\"},{\"camera\":1,\"translation\":[1,1,1],\"name\":\"top\"},"
        "{\"camera\":0,\"scale\":[0,0,0]}],\"scenes\":[{\"nodes\":[0,2,4]}]");
    assert_int_equal(scene.camera_count, 3);
    assert_string_equal(scene.cameras[0].name, "top");
    assert_true(scene.cameras[0].orthographic && scene.cameras[0].ymag == 3);
    assert_near3(scene.cameras[0].eye, 2, 3, -4);
    assert_string_equal(scene.cameras[1].name, "lens");
    assert_true(!scene.cameras[1].orthographic && scene.cameras[1].yfov == 0.5);
    assert_string_equal(scene.cameras[2].name, "last");
    for (size_t i = 0; i < 3; i++) {
        const glint_camera *camera = &scene.cameras[i];
        glint_vec3 cross = glint_vec3_cross(camera->right, camera->up);
        assert_near3(cross, camera->back.x, camera->back.y, camera->back.z);
    }
    glint_scene_free(&scene);
}

// Checks the glass's values from extensions.
static void assert_layers(const glint_material *glass)
{
    assert_true(glint_material_lobes(glass).solid && glint_material_lobes(glass).specular);
    assert_true(glass->specular == 0.5f && glass->specular_color[0] == 0 &&
                glass->specular_color[2] == 40);
    assert_true(glass->dispersion == 2 && glint_material_lobes(glass).dispersion);
    assert_true(glass->anisotropy == 0.5f && glass->anisotropy_rotation == -2);
    assert_true(glass->diffuse_transmission == 0.5f &&
                glass->diffuse_transmission_color[1] == 0.5f);
    assert_true(glass->sheen_color[0] == 0.5f && glass->sheen_color[1] == 0 &&
                glass->sheen_color[2] == 1 && glass->sheen_roughness == 0.75f);
    assert_true(glass->iridescence == 0.5f && glass->iridescence_ior == 1.5f);
    assert_true(glass->iridescence_thickness[0] == 50 && glass->iridescence_thickness[1] == 400);
    assert_true(glass->clearcoat == 0.5f && glass->clearcoat_roughness == 0.25f);
}

static void materials_are_read_and_only_the_used_ones_kept(void **state)
{
    const char *rest = TETRAHEDRON_STORAGE
        ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE ",\"material\":2},"
        "{" TETRAHEDRON_PRIMITIVE "},{" TETRAHEDRON_PRIMITIVE ",\"material\":1}]}],"
        "\"nodes\":[{\"mesh\":0}]," ONE_SCENE ",\"materials\":["
        "{\"name\":\"unused\",\"alphaMode\":\"BLEND\"},"
        "{\"name\":\"glass\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.25,1,0.5],"
        "\"metallicFactor\":0,\"roughnessFactor\":0},\"extensions\":{"
        "\"KHR_materials_transmission\":{\"transmissionFactor\":0.75},"
        "\"KHR_materials_specular\":{\"specularFactor\":0.5,\"specularColorFactor\":[0,1,40]},"
        "\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.5,\"clearcoatRoughnessFactor\":0.25},"
        "\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0.5,\"anisotropyRotation\":-2},"
        "\"KHR_materials_diffuse_transmission\":{\"diffuseTransmissionFactor\":0.5,"
        "\"diffuseTransmissionColorFactor\":[1,0.5,0]},"
        "\"KHR_materials_sheen\":{\"sheenColorFactor\":[0.5,0,1],\"sheenRoughnessFactor\":0.75},"
        "\"KHR_materials_iridescence\":{\"iridescenceFactor\":0.5,\"iridescenceIor\":1.5,"
        "\"iridescenceThicknessMinimum\":50},"
        "\"KHR_materials_dispersion\":{\"dispersion\":2},\"KHR_materials_ior\":{\"ior\":2.4},\"KHR_"
        "materials_volume\":{\"thicknessFactor\":1,"
        "\"attenuationDistance\":0.5,\"attenuationColor\":[1,0.5,0]}}},"
        "{\"name\":\"lamp\",\"emissiveFactor\":[1,0.5,0],\"extensions\":{"
        "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":8},\"KHR_materials_unlit\":{}},"
        "\"extras\":{\"glint\":{\"mirror\":0.25},\"other\":1}}]";
    glint_scene scene = load_rest(*state, &the_tetrahedron, sizeof the_tetrahedron, rest);
    assert_int_equal(scene.material_count, 3);
    const glint_material *glass = &scene.materials[0];
    assert_string_equal(glass->name, "glass");
    assert_true(glass->base_color[0] == 0.5f && glass->base_color[1] == 0.25f);
    assert_true(glass->metallic == 0 && glass->roughness == 0 && glass->transmission == 0.75f);
    assert_true(glass->ior == 2.4f && glass->thickness == 1 && glass->mirror == -1);
    assert_true(glass->attenuation_distance == 0.5f && glass->attenuation_color[1] == 0.5f);
    assert_layers(glass);
    const glint_material *lamp = &scene.materials[1];
    assert_string_equal(lamp->name, "lamp");
    assert_true(lamp->emission[0] == 8 && lamp->emission[1] == 4 && lamp->emission[2] == 0);
    assert_true(lamp->unlit && lamp->mirror == 0.25f && isinf(lamp->attenuation_distance));
    assert_null(scene.materials[2].name); // the default material
    assert_true(scene.materials[2].specular == 1 && scene.materials[2].specular_color[2] == 1);
    assert_int_equal(scene.instances[0].material, 1);
    assert_int_equal(scene.instances[1].material, 2);
    assert_int_equal(scene.instances[2].material, 0);
    assert_int_equal(scene.material_of[0], 1);
    assert_int_equal(scene.material_of[4], 2);
    assert_int_equal(scene.material_of[8], 0);
    glint_scene_free(&scene);
}

static const char much_that_is_not_modelled[] = TETRAHEDRON_STORAGE
    ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":1},"
    "\"indices\":2,\"material\":0,\"targets\":[{\"POSITION\":0}]},"
    "{" TETRAHEDRON_PRIMITIVE ",\"material\":1},{\"attributes\":{\"POSITION\":0},\"mode\":0},"
    "{\"attributes\":{\"POSITION\":0},\"mode\":3}]}],"
    "\"nodes\":[{\"mesh\":0,\"skin\":0,\"name\":\"n\"},{\"mesh\":0,\"rotation\":[0,0,0,2],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}],\"skins\":[{\"joints\":[0]}],"
    "\"scenes\":[{\"nodes\":[0,1]}],\"animations\":[{\"name\":\"spin\",\"samplers\":[],"
    "\"channels\":[]},"
    "{\"samplers\":[],\"channels\":[]}],"
    "\"textures\":[{}],\"materials\":[{\"name\":\"gold\",\"alphaMode\":\"MASK\","
    "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}},"
    "\"extras\":{\"glint\":{\"miror\":1}}},"
    "{\"name\":\"lens\",\"extensions\":{\"KHR_materials_volume_scatter\":{},"
    "\"KHR_materials_transmission\":{\"transmissionTexture\":{\"index\":0}},"
    "\"KHR_materials_volume\":{\"thicknessFactor\":1,\"thicknessTexture\":{\"index\":0}}}}],"
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\"}]}},"
    "\"extensionsUsed\":[\"KHR_materials_volume_scatter\"]";

static const char *const said_of_it[] = {
    ": 2 point and 2 line primitives are skipped",
    "meshes[0].primitives[0] and 1 more: a skin does not move it, as it has no JOINTS_0",
    "nodes[1]: lights have no size",
    "nodes[1]: the rotation is no unit quaternion",
    "animations[0] \"spin\": the first of 2 animations is shown",
    "textures[0]: no image of a kind that is read (PNG, JPEG, WebP, DDS); the maps that",
    "materials[0] \"gold\": extras.glint.\"miror\" is unknown",
    "materials[1] \"lens\": KHR_materials_volume_scatter is not modelled",
};

static const struct {
    const char *name;
    glint_treatment treatment;
} used_of_it[] = {
    {"KHR_materials_volume_scatter", GLINT_IGNORED},
    {"roughness", GLINT_RENDERED},
    {"alphaMode MASK", GLINT_RENDERED},
    {"COLOR_0", GLINT_RENDERED},
    {"baseColorTexture", GLINT_IGNORED},
    {"transmissionTexture", GLINT_IGNORED},
    {"thicknessTexture", GLINT_APPROXIMATED},
    {"morph targets", GLINT_RENDERED},
    {"points and lines", GLINT_IGNORED},
};

static void what_is_not_modelled_is_said_once(void **state)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, much_that_is_not_modelled);
    glint_scene scene;
    glint_warnings warnings = {0};
    glint_error error = {0};
    if (load_text(*state, text, &scene, &warnings, &error) != GLINT_OK) {
        fail_msg("%s", error.message);
    }
    size_t count = sizeof said_of_it / sizeof said_of_it[0];
    for (size_t i = 0; i < count; i++) {
        if (!any_warning_has(&warnings, said_of_it[i])) {
            fail_msg("not said: %s", said_of_it[i]);
        }
    }
    assert_int_equal(warnings.count, count);
    for (size_t i = 0; i < sizeof used_of_it / sizeof *used_of_it; i++) {
        assert_string_equal(scene.usages[i].name, used_of_it[i].name);
        assert_int_equal(scene.usages[i].treatment, used_of_it[i].treatment);
    }
    assert_int_equal(scene.usage_count, sizeof used_of_it / sizeof *used_of_it);
    assert_int_equal(scene.skipped_points, 2);
    assert_int_equal(scene.skipped_lines, 2);
    glint_scene_free(&scene);
    glint_warnings_free(&warnings);
    free(text);
}

static void a_plain_scene_is_loaded_without_a_word(void **state)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron,
                           TETRAHEDRON_STORAGE
                           ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE
                           ",\"material\":0}]}],\"nodes\":[{\"mesh\":0}]," ONE_SCENE
                           ",\"materials\":[{\"pbrMetallicRoughness\":{\"roughnessFactor\":0}}]");
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    assert_int_equal(warnings.count, 0);
    glint_scene_free(&scene);
    free(text);
}

static void buffers_come_from_files_data_uris_and_glb(void **state)
{
    const char *folder = *state;
    write_bytes(folder, "my buffer.bin", &the_tetrahedron, sizeof the_tetrahedron);
    const char *format =
        "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":120.0,\"uri\":"
        "\"%s\"}]," TETRAHEDRON ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE "}";
    const char *uris[] = {"my%20buffer.bin", "my buffer.bin", "./my%20buffer.bin"};
    glint_scene expected = load_tetrahedron(folder, "\"nodes\":[{\"mesh\":0}]," ONE_SCENE);
    for (size_t i = 0; i < 4; i++) {
        glint_scene scene;
        glint_error error = {0};
        const char *path;
        if (i < 3) {
            char text[2048];
            snprintf(text, sizeof text, format, uris[i]);
            path = write_bytes(folder, "test.gltf", text, strlen(text));
        } else {
            size_t size;
            unsigned char *glb =
                glb_bytes(&the_tetrahedron, sizeof the_tetrahedron,
                          TETRAHEDRON ",\"nodes\":[{\"mesh\":0}]," ONE_SCENE, &size);
            // The file's content tells the format, not its name.
            path = write_bytes(folder, "test.gltf", glb, size);
            free(glb);
        }
        if (glint_scene_load(path, NULL, &scene, NULL, &error) != GLINT_OK) {
            fail_msg("%s", error.message);
        }
        assert_int_equal(scene.triangle_count, 4);
        assert_int_equal(scene.vertex_count, 4);
        assert_memory_equal(scene.positions, expected.positions, 12 * sizeof(float));
        assert_memory_equal(scene.indices, expected.indices, 12 * sizeof *scene.indices);
        glint_scene_free(&scene);
    }
    glint_scene_free(&expected);
}

static void data_uris_may_have_any_media_type(void **state)
{
    // A triangle: 36 bytes, of which the 1.0f are 00 00 80 3F.
    const char *heads[] = {
        "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
        "DATA:model/x.y;name=\\\"q\\\";BASE64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
        "data:application/gltf-buffer;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
        "data:,%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80?%00%00%00%00%00%00%00%00%00%00%00%00"
        "%00%00%80%3F%00%00%00%00",
    };
    for (size_t i = 0; i < 4; i++) {
        char text[2048];
        snprintf(
            text, sizeof text,
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":["
            "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
            "\"nodes\":[{\"mesh\":0}]," ONE_SCENE "}",
            heads[i]);
        glint_scene scene;
        glint_error error = {0};
        if (load_text(*state, text, &scene, NULL, &error) != GLINT_OK) {
            fail_msg("%s", error.message);
        }
        assert_near3(corner(&scene, 0, 2), 0, 1, 0);
        glint_scene_free(&scene);
    }
}

// The convexity proof is for spheres and boxes from modelling programs.
static const struct {
    const char *name;
    size_t triangles, cameras, convex;
} models[] = {
    {"01_sphere/01_sphere.gltf", 960, 0, 1},
    {"01_metallic_sphere/01_metallic_sphere.gltf", 960, 0, 1},
    {"01_vertex_count_32bit/01_vertex_count_32bit.gltf", 130380, 0, 0},
    {"02_node_hierarchy/02_node_hierarchy.gltf", 60, 0, 2},
    {"02_suzanne/02_suzanne.gltf", 3936, 0, 0},
    {"15_transmission/15_transmission.gltf", 4800, 0, 5},
    {"17_ior/17_ior.gltf", 60, 0, 5},
    {"24_gpu_instancing/24_gpu_instancing.gltf", 7656770, 0, 0},
    {"AnimatedMorphCube/glTF/AnimatedMorphCube.gltf", 12, 0, 1},
    {"AttenuationTest.glb", 292, 0, 20},
    {"SunglassesKhronos.glb", 13396, 0, 0},
    {"cameras/Cameras.gltf", 2, 2, 0},
    {"simple_skin/quad_skin.glb", 2, 0, 0},
    {"charts/heart_draco.glb", 180, 0, 0},
    {"real/bunny.glb", 144046, 0, 1},
    {"real/Ingenuity.glb", 9060, 0, 24},
    {"real/carbon-sphere.glb", 215579, 0, 0},
    {"usd-shaderball-ball.glb", 63856, 0, 0},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_05.gltf", 2, 0, 0},
    {"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_12.gltf", 2, 0, 0},
};

static void models_load_as_their_makers_meant(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof models / sizeof models[0]; i++) {
        const char *path = folder_path(GLINT_SOURCE_DIR "/../shared/assets/gltf", models[i].name);
        FILE *file = fopen(path, "rb");
        if (file == NULL) {
            print_message("%s is not there: skipped\n", path);
            skip();
            return;
        }
        fclose(file);
        glint_scene scene;
        glint_topology topology;
        glint_error error = {0};
        if (glint_scene_load(path, NULL, &scene, NULL, &error) != GLINT_OK) {
            fail_msg("%s", error.message);
        }
        assert_int_equal(scene.triangle_count + scene.degenerate_triangles, models[i].triangles);
        assert_int_equal(scene.camera_count, models[i].cameras);
        assert_int_equal(glint_topology_find(&scene, &topology, &error), GLINT_OK);
        size_t convex = 0;
        for (size_t c = 0; c < topology.component_count; c++) {
            convex += topology.components[c].convex;
        }
        assert_int_equal(convex, models[i].convex);
        glint_topology_free(&topology);
        glint_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_chosen_by_default_name_and_index),
        cmocka_unit_test(a_file_without_scenes_shows_every_root),
        cmocka_unit_test(cameras_come_depth_first_without_scale),
        cmocka_unit_test(materials_are_read_and_only_the_used_ones_kept),
        cmocka_unit_test(what_is_not_modelled_is_said_once),
        cmocka_unit_test(a_plain_scene_is_loaded_without_a_word),
        cmocka_unit_test(buffers_come_from_files_data_uris_and_glb),
        cmocka_unit_test(data_uris_may_have_any_media_type),
        cmocka_unit_test(models_load_as_their_makers_meant),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
