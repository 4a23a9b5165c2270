// Tests the built-in scenes. They must have the properties that the loader checks in files.
#include "scene/built_in.h"
#include "scene/shape/topology.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void load(size_t index, glint_scene *scene)
{
    glint_error error = {0};
    assert_int_equal(glint_built_in_scene(glint_built_in_name(index), scene, &error), GLINT_OK);
}

static void there_are_some_and_other_names_are_refused(void **state)
{
    (void)state;
    size_t count = 0;
    while (glint_built_in_name(count) != NULL) {
        assert_non_null(glint_built_in_summary(count));
        count++;
    }
    assert_true(count >= 3);
    assert_null(glint_built_in_summary(count));
    glint_scene scene;
    glint_error error = {0};
    assert_int_equal(glint_built_in_scene("miror", &scene, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "miror"));
    assert_int_equal(scene.triangle_count, 0);
}

static void positions_are_stored_within_the_unit(void **state)
{
    (void)state;
    for (size_t i = 0; glint_built_in_name(i) != NULL; i++) {
        glint_scene scene;
        load(i, &scene);
        int exponent;
        assert_true(frexp(scene.unit, &exponent) == 0.5); // a power of two
        for (size_t k = 0; k < 9 * scene.triangle_count; k++) {
            assert_true(fabsf(scene.positions[k]) <= 1);
        }
        glint_vec3 extent = glint_vec3_subtract(scene.high, scene.low);
        assert_true(extent.x > 1 && extent.y > 1 && extent.z > 1);
        glint_scene_free(&scene);
    }
}

static glint_vec3 vector_at(const float *values)
{
    return (glint_vec3){(double)values[0], (double)values[1], (double)values[2]};
}

// Compares the gradient of the formula with the triangles made from it. The edges are 0.02 long
// (0.04 in "mixed") and the curvature is below 12, so normals turn by less than half a radian over
// an edge.
static void normals_are_unit_and_those_of_the_surface(void **state)
{
    (void)state;
    for (size_t i = 0; glint_built_in_name(i) != NULL; i++) {
        glint_scene scene;
        load(i, &scene);
        for (size_t t = 0; t < scene.triangle_count; t++) {
            const float *p = scene.positions + 9 * t;
            glint_vec3 edge1 = glint_vec3_subtract(vector_at(p + 3), vector_at(p));
            glint_vec3 edge2 = glint_vec3_subtract(vector_at(p + 6), vector_at(p));
            glint_vec3 face = glint_vec3_normalize(glint_vec3_cross(edge1, edge2));
            for (int k = 0; k < 3; k++) {
                glint_vec3 normal = vector_at(scene.normals + 9 * t + 3 * k);
                assert_true(fabs(glint_vec3_length(normal) - 1) < 1e-6);
                assert_true(glint_vec3_dot(normal, face) > cos(0.5));
            }
        }
        glint_scene_free(&scene);
    }
}

static void spheres_are_closed_surfaces(void **state)
{
    (void)state;
    for (size_t i = 0; glint_built_in_name(i) != NULL; i++) {
        glint_scene scene;
        glint_topology topology;
        load(i, &scene);
        assert_int_equal(glint_topology_find(&scene, &topology, NULL), GLINT_OK);
        size_t open = 0;
        for (size_t c = 0; c < topology.component_count; c++) {
            open += !topology.components[c].closed;
        }
        bool has_floor = scene.instance_count > 1;
        assert_int_equal(open, has_floor ? 1 : 0);
        assert_int_equal(topology.boundary_edges, has_floor ? 4 : 0);
        assert_int_equal(topology.component_count, scene.instance_count);
        glint_topology_free(&topology);
        glint_scene_free(&scene);
    }
}

static void instances_cover_the_triangles_and_the_camera_looks_at_them(void **state)
{
    (void)state;
    for (size_t i = 0; glint_built_in_name(i) != NULL; i++) {
        glint_scene scene;
        load(i, &scene);
        size_t covered = 0;
        for (size_t k = 0; k < scene.instance_count; k++) {
            const glint_instance *instance = &scene.instances[k];
            assert_int_equal(instance->first_triangle, covered);
            covered += instance->triangle_count;
            assert_true(instance->material < scene.material_count);
        }
        assert_int_equal(covered, scene.triangle_count);
        glint_camera camera;
        assert_int_equal(glint_scene_camera(&scene, NULL, &camera, NULL), GLINT_OK);
        assert_true(glint_vec3_dot(camera.back, camera.eye) > 0.9 * glint_vec3_length(camera.eye));
        glint_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(there_are_some_and_other_names_are_refused),
        cmocka_unit_test(positions_are_stored_within_the_unit),
        cmocka_unit_test(normals_are_unit_and_those_of_the_surface),
        cmocka_unit_test(spheres_are_closed_surfaces),
        cmocka_unit_test(instances_cover_the_triangles_and_the_camera_looks_at_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
