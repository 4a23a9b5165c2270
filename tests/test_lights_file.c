// Tests punctual lights in files: parsing, places by nodes, animation, and faults.
#include "scene/scene.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define LIGHTS(list) ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[" list "]}}"
#define LIT "\"extensions\":{\"KHR_lights_punctual\":{\"light\":"

static void assert_vector(glint_vec3 got, double x, double y, double z)
{
    if (!(fabs(got.x - x) <= 1e-15 * fabs(x) + 1e-15 &&
          fabs(got.y - y) <= 1e-15 * fabs(y) + 1e-15 &&
          fabs(got.z - z) <= 1e-15 * fabs(z) + 1e-15)) {
        fail_msg("(%.17g, %.17g, %.17g) instead of (%.17g, %.17g, %.17g)", got.x, got.y, got.z, x,
                 y, z);
    }
}

static void lights_are_read_with_their_defaults(void **state)
{
    glint_scene scene = load_tetrahedron(
        *state, TETRAHEDRON LIGHTS(
                    "{\"type\":\"directional\"},"
                    "{\"type\":\"point\",\"name\":\"bulb\",\"color\":[0.5,0.25,2],"
                    "\"intensity\":8,\"range\":3},"
                    "{\"type\":\"spot\",\"spot\":{}},"
                    "{\"type\":\"spot\",\"spot\":{\"innerConeAngle\":0.25,"
                    "\"outerConeAngle\":0.5}}") ",\"extensionsRequired\":[\"KHR_lights_punctual\"],"
                                                "\"extensionsUsed\":[\"KHR_lights_punctual\"],"
                                                "\"scenes\":[{\"nodes\":[0,1,2,3,4]}],"
                                                "\"nodes\":[{\"mesh\":0},"
                                                "{" LIT "0}}},"
                                                "{" LIT "1}},\"translation\":[1,2,3]},"
                                                "{" LIT "2}},\"name\":\"stage\"},{" LIT "3}}},"
                                                "{" LIT "1}},\"name\":\"of another scene\"}]");
    assert_int_equal(scene.light_count, 4);
    const glint_punctual_light *l = scene.lights;
    assert_int_equal(l[0].kind, GLINT_PUNCTUAL_DIRECTIONAL);
    assert_true(l[0].name == NULL && l[0].node_index == 1 && l[0].color[2] == 1);
    assert_vector(l[0].direction, 0, 0, -1);
    assert_int_equal(l[1].kind, GLINT_PUNCTUAL_POINT);
    assert_string_equal(l[1].name, "bulb");
    assert_true(l[1].color[0] == 4 && l[1].color[1] == 2 && l[1].color[2] == 16);
    assert_true(l[1].range == 3);
    assert_vector(l[1].position, 1, 2, 3);
    assert_int_equal(l[2].kind, GLINT_PUNCTUAL_SPOT);
    assert_string_equal(l[2].name, "stage");
    assert_true(isinf(l[2].range) && l[2].inner_angle == 0);
    assert_true(fabs(l[2].outer_angle - atan(1)) < 1e-15);
    assert_true(l[3].inner_angle == 0.25 && l[3].outer_angle == 0.5);
    assert_string_equal(scene.usages[0].name, "KHR_lights_punctual");
    assert_int_equal(scene.usages[0].treatment, GLINT_APPROXIMATED);
    glint_scene_free(&scene);
}

// A parent rotates, scales and mirrors. Instances of a node's mesh do not multiply its light.
static void nodes_place_lights_and_scale_none(void **state)
{
    glint_scene scene =
        load_tetrahedron(*state, TETRAHEDRON_STORAGE
                         ",\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE
                         "}]}]" LIGHTS("{\"type\":\"spot\",\"spot\":{},\"intensity\":5,\"range\":"
                                       "2}") ",\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
                                             "\"children\":[1],\"translation\":[0,7,0],"
                                             "\"rotation\":[0,0.70710678118654752,0,0."
                                             "70710678118654752],\"scale\":[2,3,-4]},"
                                             "{\"mesh\":0,\"translation\":[1,1,1],\"extensions\":{"
                                             "\"KHR_lights_punctual\":{\"light\":0},"
                                             "\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
                                             "\"TRANSLATION\":0}}}}]");
    assert_true(scene.instance_count == 4 && scene.light_count == 1);
    // The quarter turn maps +z to +x and +x to −z. The scale maps (1, 1, 1) to (2, 3, −4).
    assert_vector(scene.lights[0].position, -4, 10, -2);
    assert_vector(scene.lights[0].direction, 1, 0, 0);
    assert_true(scene.lights[0].color[0] == 5 && scene.lights[0].range == 2);
    glint_scene_free(&scene);
}

static void lights_that_shine_nowhere_are_left_out(void **state)
{
    char *text = gltf_text(
        &the_tetrahedron, sizeof the_tetrahedron,
        TETRAHEDRON LIGHTS(
            "{\"type\":\"directional\"},{\"type\":\"point\"}") ",\"scenes\":[{\"nodes\":[0,1,2]}],"
                                                               "\"nodes\":[{\"mesh\":0},"
                                                               "{" LIT
                                                               "0}},\"scale\":[0,0,0]},{" LIT
                                                               "1}},\"scale\":[0,0,0]}]");
    glint_scene scene;
    glint_warnings warnings = {0};
    assert_int_equal(load_text(*state, text, &scene, &warnings, NULL), GLINT_OK);
    assert_int_equal(scene.light_count, 1); // a point light shines all around
    assert_int_equal(scene.lights[0].kind, GLINT_PUNCTUAL_POINT);
    assert_true(any_warning_has(&warnings, "nodes[1]: the light shines nowhere"));
    assert_true(any_warning_has(&warnings, "nodes[1] and 1 more: lights have no size"));
    glint_warnings_free(&warnings);
    glint_scene_free(&scene);
    free(text);
}

// ---- Over time ----------------------------------------------------------------------------------

typedef struct moving_data {
    tetrahedron mesh;
    float times[2];
    float places[2][3];
} moving_data;

static void lights_move_with_their_nodes(void **state)
{
    const moving_data data = {the_tetrahedron, {0, 2}, {{0, 1, 0}, {4, 1, 0}}};
    char *text = gltf_text(
        &data, sizeof data,
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":48},"
        "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":24},"
        "{\"buffer\":0,\"byteOffset\":120,\"byteLength\":8},"
        "{\"buffer\":0,\"byteOffset\":128,\"byteLength\":24}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":2,\"componentType\":5123,\"count\":12,\"type\":\"SCALAR\"},"
        "{\"bufferView\":3,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\",\"min\":[0],"
        "\"max\":[2]},"
        "{\"bufferView\":4,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}],"
        "\"meshes\":[{\"primitives\":[{" TETRAHEDRON_PRIMITIVE "}]}]" LIGHTS(
            "{\"type\":\"point\"}") ",\"scenes\":[{\"nodes\":[0,1]}],"
                                    "\"nodes\":[{\"mesh\":0},{\"children\":[2]},{" LIT "0}}}],"
                                    "\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":"
                                    "{\"node\":1,\"path\":\"translation\"}}],"
                                    "\"samplers\":[{\"input\":3,\"output\":4}]}]");
    const char *path = write_bytes(*state, "moving.gltf", text, strlen(text));
    glint_scene_source *source;
    assert_int_equal(glint_scene_open(path, NULL, &source, NULL), GLINT_OK);
    const glint_motion *motion = glint_scene_motion(source);
    assert_true(motion->moves_lights && !motion->moves_triangles && !motion->moves_cameras);
    assert_true(glint_motion_moves_scene(motion) && motion->duration == 2);
    static const double at[][2] = {{0, 0}, {0.5, 1}, {2, 4}, {3, 4}};
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        glint_scene scene;
        assert_int_equal(glint_scene_at(source, at[i][0], &scene, NULL, NULL), GLINT_OK);
        assert_int_equal(scene.light_count, 1);
        assert_vector(scene.lights[0].position, at[i][1], 1, 0);
        assert_false(scene.moves); // the triangles do not move
        glint_scene_free(&scene);
    }
    glint_scene_close(source);
    free(text);
}

// ---- Faults -------------------------------------------------------------------------------------

#define NODE ",\"nodes\":[{\"mesh\":0," LIT "0}}}]," ONE_SCENE
#define LIGHT(text) TETRAHEDRON NODE LIGHTS("{" text "}")
#define SPOT(text) LIGHT("\"type\":\"spot\",\"spot\":{" text "}")

// Loads a file, which must say one line beside the one about lights' size. `lights`: how many are
// there.
static glint_scene load_faulty(const char *folder, const char *rest, const char *said,
                               size_t lights)
{
    char *text = gltf_text(&the_tetrahedron, sizeof the_tetrahedron, rest);
    glint_scene scene;
    glint_warnings warnings = {0};
    glint_error error = {0};
    if (load_text(folder, text, &scene, &warnings, &error) != GLINT_OK) {
        fail_msg("%s: refused: %s", rest, error.message);
    }
    if (warnings.count != (said != NULL ? 2 : 1) ||
        (said != NULL && !any_warning_has(&warnings, said))) {
        fail_msg("%s: said \"%s\", expected \"%s\"", rest, warnings.texts[warnings.count - 1],
                 said);
    }
    assert_true(scene.triangle_count == 4 && scene.light_count == lights);
    glint_warnings_free(&warnings);
    free(text);
    return scene;
}

#define LEFT_OUT "; the light is left out"

static void lights_that_cannot_be_read_are_left_out(void **state)
{
    static const char *const cases[][2] = {
        {LIGHT(""), "lights[0]: type \"\" is none (directional, point or spot)" LEFT_OUT},
        {LIGHT("\"type\":\"area\""), "lights[0]: type \"area\" is none"},
        {TETRAHEDRON NODE LIGHTS("7"), "lights[0]: 7 stands where an object must stand" LEFT_OUT},
        {LIGHT("\"type\":\"point\",\"intensity\":-1"), "intensity is less than 0" LEFT_OUT},
        {LIGHT("\"type\":\"directional\",\"range\":\"far\""), "the text \"far\" stands where"},
        {LIGHT("\"type\":\"point\",\"color\":1"), "1 stands where an array"},
        {LIGHT("\"type\":\"point\",\"color\":[1,-0.5,1]"), "color is less than 0" LEFT_OUT},
        {LIGHT("\"type\":\"spot\""), "missing"},
        {LIGHT("\"type\":\"spot\",\"spot\":1"), "1 stands where an object"},
        {TETRAHEDRON NODE, "nodes[0]: 0: there is no such light (the file has none"},
        {TETRAHEDRON NODE ",\"extensions\":{\"KHR_lights_punctual\":{}}",
         "nodes[0]: 0: there is no such light"},
        {TETRAHEDRON NODE ",\"extensions\":{\"KHR_lights_punctual\":7}",
         "nodes[0]: 0: there is no such light"},
        {TETRAHEDRON ",\"nodes\":[{\"mesh\":0," LIT
                     "-1}}}]," ONE_SCENE LIGHTS("{\"type\":\"point\"}"),
         "nodes[0]: -1: there is no such light (the file has 1 light, counted from 0); the node "
         "has "
         "no light"},
        {TETRAHEDRON
         ",\"nodes\":[{\"mesh\":0,\"extensions\":{\"KHR_lights_punctual\":{}}}]," ONE_SCENE LIGHTS(
             "{\"type\":\"point\"}"),
         "nodes[0]: it names no light; the node has no light"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_scene scene = load_faulty(*state, cases[i][0], cases[i][1], 0);
        glint_scene_free(&scene);
    }
}

static void small_faults_of_lights_are_mended(void **state)
{
    static const struct {
        const char *rest, *said;
        double range, inner, outer;
    } cases[] = {
        {LIGHT("\"type\":\"point\",\"intensity\":null"), NULL, INFINITY, 0, 0},
        {LIGHT("\"type\":\"point\",\"name\":1"), NULL, INFINITY, 0, 0},
        {LIGHT("\"type\":\"point\",\"color\":[1,0.5]"), "lights[0]: color has not 3 numbers",
         INFINITY, 0, 0},
        {LIGHT("\"type\":\"point\",\"range\":0"),
         "lights[0]: range is no distance (it counts as unlimited)", INFINITY, 0, 0},
        {LIGHT("\"type\":\"point\",\"range\":-2"), "range is no distance", INFINITY, 0, 0},
        {SPOT("\"innerConeAngle\":0.3,\"outerConeAngle\":0.3"), NULL, INFINITY, 0.3, 0.3},
        {SPOT("\"innerConeAngle\":0.5,\"outerConeAngle\":0.3"),
         "lights[0]: innerConeAngle is out of range (the nearest angle within counts)", INFINITY,
         0.3, 0.3},
        {SPOT("\"innerConeAngle\":-0.1"), "innerConeAngle is out of range", INFINITY, 0,
         0.78539816339744831},
        {SPOT("\"outerConeAngle\":1.6"), "outerConeAngle is out of range", INFINITY, 0,
         1.5707963267948966},
        {SPOT("\"outerConeAngle\":1.57079637"), NULL, INFINITY, 0, 1.5707963267948966}, // a float
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_scene scene = load_faulty(*state, cases[i].rest, cases[i].said, 1);
        assert_true(scene.lights[0].range == cases[i].range);
        assert_true(scene.lights[0].color[0] == 1);
        if (scene.lights[0].kind == GLINT_PUNCTUAL_SPOT) {
            assert_true(fabs(scene.lights[0].inner_angle - cases[i].inner) < 1e-15);
            assert_true(fabs(scene.lights[0].outer_angle - cases[i].outer) < 1e-15);
        }
        glint_scene_free(&scene);
    }
}

int main(void)
{
#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)
    const struct CMUnitTest tests[] = {
        IN_A_FOLDER(lights_are_read_with_their_defaults),
        IN_A_FOLDER(nodes_place_lights_and_scale_none),
        IN_A_FOLDER(lights_that_shine_nowhere_are_left_out),
        IN_A_FOLDER(lights_move_with_their_nodes),
        IN_A_FOLDER(lights_that_cannot_be_read_are_left_out),
        IN_A_FOLDER(small_faults_of_lights_are_mended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
