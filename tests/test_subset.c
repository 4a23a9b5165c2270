// Tests scenes without some of their nodes: the remaining triangles, their names, and refusals.
#include "scene/subset.h"

#include "support/by_corner.h"
#include "support/gltf_text.h"
#include "support/scratch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define MESH_OF(material) "{" TETRAHEDRON_PRIMITIVE ",\"material\":" material "}"

// A group with two tetrahedra of two materials. One of them has the same name as a third
// tetrahedron beside the group; a fourth has no name. The bounds of a tetrahedron are a unit cube
// at its node's translation.
static glint_scene load(void **state)
{
    return load_rest(
        *state, &the_tetrahedron, sizeof the_tetrahedron,
        TETRAHEDRON_STORAGE
        ",\"meshes\":[{\"primitives\":[" MESH_OF("0") "]},{\"primitives\":[" MESH_OF(
            "1") "]},{\"primitives\":[" MESH_OF("2") "]}],"
                                                     "\"materials\":[{\"name\":\"red\"},{\"name\":"
                                                     "\"green\"},{\"name\":\"blue\"}],"
                                                     "\"nodes\":[{\"name\":\"group\",\"children\":["
                                                     "1,2],\"translation\":[10,0,0]},"
                                                     "{\"name\":\"same\",\"mesh\":0},{\"name\":"
                                                     "\"in\",\"mesh\":1,\"translation\":[0,5,0]},"
                                                     "{\"name\":\"same\",\"mesh\":2,"
                                                     "\"translation\":[0,0,20]},"
                                                     "{\"mesh\":0,\"translation\":[-30,0,0]}],"
                                                     "\"scenes\":[{\"nodes\":[0,3,4]}]");
}

static void expect(const glint_scene *scene, size_t instances, size_t materials, const char *names)
{
    char found[200] = "";
    assert_int_equal(scene->instance_count, instances);
    assert_int_equal(scene->material_count, materials);
    size_t triangles = 0;
    for (size_t i = 0; i < instances; i++) {
        const glint_instance *instance = &scene->instances[i];
        const char *material = scene->materials[instance->material].name;
        const size_t length = strlen(found);
        snprintf(found + length, sizeof found - length, "%s%s:%s", i > 0 ? " " : "",
                 instance->node != NULL ? instance->node : "-", material);
        assert_int_equal(instance->first_triangle, triangles);
        for (size_t t = 0; t < instance->triangle_count; t++) {
            assert_int_equal(scene->material_of[triangles + t], instance->material);
        }
        triangles += instance->triangle_count;
    }
    assert_int_equal(scene->triangle_count, triangles);
    assert_string_equal(found, names);
}

static void assert_x(const glint_scene *scene, double low, double high)
{
    assert_true(fabs(scene->low.x - low) <= 1e-5 && fabs(scene->high.x - high) <= 1e-5);
}

static void nodes_are_taken_away_with_all_that_hangs_under_them(void **state)
{
    const struct {
        const char *nodes;
        size_t instances, materials;
        const char *names;
        double low, high;
    } cases[] = {
        {"in", 3, 2, "same:red same:blue -:red", -30, 11},
        {"group", 2, 2, "same:blue -:red", -30, 1},
        {"0", 2, 2, "same:blue -:red", -30, 1},
        {"same", 2, 2, "in:green -:red", -30, 11},
        {"4,in", 2, 2, "same:red same:blue", 0, 11},
        {"group,in,same", 1, 1, "-:red", -30, -29},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        glint_scene scene = load(state);
        glint_error error = {0};
        assert_x(&scene, -30, 11);
        assert_int_equal(glint_scene_remove_nodes(&scene, cases[i].nodes, &error), GLINT_OK);
        expect(&scene, cases[i].instances, cases[i].materials, cases[i].names);
        assert_x(&scene, cases[i].low, cases[i].high);
        glint_scene_free(&scene);
    }
}

static void nodes_are_kept_as_others_are_taken_away(void **state)
{
    const char *const kept[] = {"group", "same", "4", "in,3", "group,same,4"};
    const char *const taken[] = {"3,4", "in,4", "group,3", "1,4", NULL};
    for (size_t i = 0; i < 5; i++) {
        glint_scene left = load(state), right = load(state);
        glint_error error = {0};
        assert_int_equal(glint_scene_keep_nodes(&left, kept[i], &error), GLINT_OK);
        if (taken[i] != NULL) {
            assert_int_equal(glint_scene_remove_nodes(&right, taken[i], &error), GLINT_OK);
        }
        assert_int_equal(left.triangle_count, right.triangle_count);
        scene_by_corner(&left);
        scene_by_corner(&right);
        assert_memory_equal(left.positions, right.positions,
                            9 * sizeof *left.positions * left.triangle_count);
        assert_memory_equal(left.normals, right.normals,
                            9 * sizeof *left.normals * left.triangle_count);
        assert_memory_equal(&left.low, &right.low, sizeof left.low);
        glint_scene_free(&left);
        glint_scene_free(&right);
    }
}

static void all_may_go(void **state)
{
    glint_scene scene = load(state);
    glint_error error = {0};
    assert_int_equal(glint_scene_remove_nodes(&scene, "group,3,4", &error), GLINT_OK);
    expect(&scene, 0, 0, "");
    assert_true(scene.low.x > scene.high.x);
    glint_scene_free(&scene);
}

static void what_is_not_there_is_refused(void **state)
{
    const char *const wrong[] = {"none", "9",        "-1", "",   "in,", ",in",  "in,none",
                                 "1.5",  "in group", " 1", "1 ", "0x1", "in, 1"};
    glint_scene scene = load(state);
    glint_vec3 middle = {1, 2, 3};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        glint_error error = {0};
        assert_int_equal(glint_scene_remove_nodes(&scene, wrong[i], &error), GLINT_BAD_INPUT);
        assert_non_null(strstr(error.message, "has triangles (there is 1 \"same\", 2 \"in\", 3 "
                                              "\"same\", 4)"));
        assert_int_equal(glint_scene_keep_nodes(&scene, wrong[i], &error), GLINT_BAD_INPUT);
        assert_int_equal(glint_scene_middle_of_nodes(&scene, wrong[i], &middle, &error),
                         GLINT_BAD_INPUT);
        expect(&scene, 4, 3, "same:red in:green same:blue -:red");
    }
    assert_true(middle.x == 1 && middle.z == 3);
    glint_scene_free(&scene);
}

static void the_middle_is_that_of_the_bounds(void **state)
{
    glint_scene scene = load(state);
    glint_error error = {0};
    glint_vec3 middle;
    assert_int_equal(glint_scene_middle_of_nodes(&scene, "group", &middle, &error), GLINT_OK);
    assert_true(fabs(middle.x - 10.5) <= 1e-5 && fabs(middle.y - 3) <= 1e-5);
    assert_int_equal(glint_scene_middle_of_nodes(&scene, "in,4", &middle, &error), GLINT_OK);
    assert_true(fabs(middle.x + 9.5) <= 1e-5 && fabs(middle.y - 3) <= 1e-5);
    expect(&scene, 4, 3, "same:red in:green same:blue -:red");
    glint_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_are_taken_away_with_all_that_hangs_under_them),
        cmocka_unit_test(nodes_are_kept_as_others_are_taken_away),
        cmocka_unit_test(all_may_go),
        cmocka_unit_test(what_is_not_there_is_refused),
        cmocka_unit_test(the_middle_is_that_of_the_bounds),
    };
    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
