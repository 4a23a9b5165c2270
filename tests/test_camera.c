// Tests cameras: their axes, the default camera, and selection by name.
#include "scene/camera.h"
#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void assert_near(double a, double b)
{
    if (!(fabs(a - b) <= 1e-12)) {
        fail_msg("%.17g is not %.17g", a, b);
    }
}

static void assert_vector(glint_vec3 v, double x, double y, double z)
{
    assert_near(v.x, x);
    assert_near(v.y, y);
    assert_near(v.z, z);
}

static void assert_right_handed(const glint_camera *camera)
{
    assert_near(glint_vec3_length(camera->right), 1);
    assert_near(glint_vec3_length(camera->up), 1);
    assert_near(glint_vec3_length(camera->back), 1);
    glint_vec3 cross = glint_vec3_cross(camera->right, camera->up);
    assert_vector(cross, camera->back.x, camera->back.y, camera->back.z);
}

static void the_identity_looks_along_minus_z(void **state)
{
    (void)state;
    glint_camera camera = {0};
    assert_true(glint_camera_from_matrix(&glint_mat4_identity, &camera));
    assert_vector(camera.back, 0, 0, 1);
    assert_vector(camera.up, 0, 1, 0);
    assert_vector(camera.right, 1, 0, 0);
    assert_vector(camera.eye, 0, 0, 0);
}

static void scale_and_shear_leave_axes_orthonormal(void **state)
{
    (void)state;
    glint_mat4 matrix = {
        {{3, 0.4, 0.1, 7}, {0.2, -5e-6, 0.3, 8}, {0.1, 1e-6, 200, 9}, {0, 0, 0, 1}}};
    glint_camera camera = {0};
    assert_true(glint_camera_from_matrix(&matrix, &camera));
    assert_right_handed(&camera);
    assert_vector(camera.eye, 7, 8, 9);
    glint_vec3 forward = glint_vec3_normalize((glint_vec3){0.1, 0.3, 200});
    assert_vector(camera.back, forward.x, forward.y, forward.z);
}

static void a_mirrored_node_does_not_mirror_the_picture(void **state)
{
    (void)state;
    glint_mat4 matrix = glint_mat4_identity;
    matrix.m[0][0] = -2;
    glint_camera camera = {0};
    assert_true(glint_camera_from_matrix(&matrix, &camera));
    assert_right_handed(&camera);
    assert_vector(camera.right, 1, 0, 0);
}

static void singular_matrices_make_no_camera(void **state)
{
    (void)state;
    glint_camera camera = {0};
    glint_mat4 zero = {0};
    assert_false(glint_camera_from_matrix(&zero, &camera));
    glint_mat4 flat = glint_mat4_identity;
    flat.m[1][1] = 0;
    flat.m[2][1] = 3; // up and forward are parallel
    assert_false(glint_camera_from_matrix(&flat, &camera));
    glint_mat4 broken = glint_mat4_identity;
    broken.m[0][3] = NAN;
    assert_false(glint_camera_from_matrix(&broken, &camera));
    broken.m[0][3] = 0;
    broken.m[2][2] = INFINITY;
    assert_false(glint_camera_from_matrix(&broken, &camera));
}

// The angle between the axis and the silhouette of the bounding sphere must be inside the field of
// view in every direction. The test compares tangents.
static void the_default_camera_holds_the_bounding_sphere(void **state)
{
    (void)state;
    const double sizes[] = {1e-6, 1, 1e6};
    for (int i = 0; i < 3; i++) {
        double s = sizes[i];
        glint_vec3 low = {-s + 5, -2 * s, -s};
        glint_vec3 high = {s + 5, 2 * s, 3 * s};
        glint_camera camera;
        glint_camera_frame_bounds(low, high, &camera);
        assert_false(camera.orthographic);
        assert_near(camera.yfov, 40 * GLINT_PI / 180);
        assert_right_handed(&camera);
        glint_vec3 center = glint_vec3_scale(glint_vec3_add(low, high), 0.5);
        glint_vec3 to_eye = glint_vec3_subtract(camera.eye, center);
        double radius = glint_vec3_length(glint_vec3_subtract(high, low)) / 2;
        double half_angle = asin(radius / glint_vec3_length(to_eye));
        assert_true(half_angle <= camera.yfov / 2 * (1 + 1e-6));
        assert_true(half_angle >= camera.yfov / 2 * (1 - 1e-6));
        // In front, from the right and from above.
        assert_true(to_eye.z > 0 && to_eye.x > 0 && to_eye.y > 0);
        glint_vec3 direction = glint_vec3_normalize(to_eye);
        assert_true(glint_vec3_dot(direction, camera.back) > 1 - 1e-9);
    }
}

static void without_a_box_the_default_camera_looks_from_plus_z(void **state)
{
    (void)state;
    glint_camera camera;
    glint_camera_frame_bounds((glint_vec3){INFINITY, INFINITY, INFINITY},
                              (glint_vec3){-INFINITY, -INFINITY, -INFINITY}, &camera);
    assert_vector(camera.back, 0, 0, 1);
    assert_vector(camera.eye, 0, 0, 1);
    assert_right_handed(&camera);
    glint_vec3 point = {1e9, 2, 3};
    glint_camera_frame_bounds(point, point, &camera);
    assert_vector(camera.back, 0, 0, 1);
    assert_true(camera.eye.x == 1e9 && camera.eye.z > 3);
}

static void cameras_are_chosen_by_name_then_by_index(void **state)
{
    (void)state;
    char first[] = "1";
    char second[] = "side";
    glint_camera cameras[3] = {{.name = first, .yfov = 0.1}, {.name = second, .yfov = 0.2}, {0}};
    char path[] = "box.gltf";
    glint_scene scene = {.path = path, .cameras = cameras, .camera_count = 3};
    glint_camera camera;
    glint_error error = {0};
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, &error), GLINT_OK);
    assert_near(camera.yfov, 0.1);
    assert_int_equal(glint_scene_camera(&scene, "1", &camera, &error), GLINT_OK);
    assert_near(camera.yfov, 0.1);
    assert_int_equal(glint_scene_camera(&scene, "side", &camera, &error), GLINT_OK);
    assert_near(camera.yfov, 0.2);
    assert_int_equal(glint_scene_camera(&scene, "2", &camera, &error), GLINT_OK);
    assert_null(camera.name);
    const char *wrong[] = {"3", "Side", "", "-1", "99999999999999999999", "1x"};
    for (int i = 0; i < 6; i++) {
        assert_int_equal(glint_scene_camera(&scene, wrong[i], &camera, &error), GLINT_BAD_INPUT);
        assert_non_null(strstr(error.message, "box.gltf: there is no camera"));
        assert_non_null(strstr(error.message, "0 \"1\", 1 \"side\", 2)"));
    }
}

static void the_list_of_many_cameras_is_cut(void **state)
{
    (void)state;
    static glint_camera cameras[1000];
    glint_scene scene = {.cameras = cameras, .camera_count = 1000};
    glint_camera camera;
    glint_error error = {0};
    assert_int_equal(glint_scene_camera(&scene, "none", &camera, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "0, 1, 2, "));
    assert_non_null(strstr(error.message, "...)"));
}

static void a_scene_without_cameras_is_framed(void **state)
{
    (void)state;
    glint_scene scene = {.low = {-1, -1, -1}, .high = {1, 1, 1}};
    glint_camera camera;
    glint_error error = {0};
    assert_int_equal(glint_scene_camera(&scene, NULL, &camera, &error), GLINT_OK);
    assert_true(camera.eye.z > 1);
    assert_int_equal(glint_scene_camera(&scene, "0", &camera, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "the scene has none"));
}

static void a_turntable_goes_round_its_centre(void **state)
{
    (void)state;
    const glint_vec3 centre = {3, -2, 1e6};
    glint_camera camera = {.yfov = 1};
    glint_camera_frame_bounds((glint_vec3){2, -3, 1e6 - 1}, (glint_vec3){4, -1, 1e6 + 1}, &camera);
    const glint_vec3 arm = glint_vec3_subtract(camera.eye, centre);
    for (int64_t step = -7; step <= 14; step++) {
        const glint_camera turned = glint_camera_orbit(&camera, centre, step, 7);
        assert_right_handed(&turned);
        assert_near(turned.eye.y, camera.eye.y);
        const double angle = 2 * GLINT_PI * (double)step / 7;
        const glint_vec3 own = glint_vec3_subtract(turned.eye, centre);
        // One rounding of a coordinate near 1e6 is 1.2e-10.
        assert_true(fabs(own.x - (arm.x * cos(angle) + arm.z * sin(angle))) < 1e-9);
        assert_true(fabs(own.z - (arm.z * cos(angle) - arm.x * sin(angle))) < 1e-9);
        const glint_camera whole = glint_camera_orbit(&camera, centre, step + 7, 7);
        assert_memory_equal(&whole.eye, &turned.eye, sizeof whole.eye);
    }
}

static void a_camera_looks_at_its_target(void **state)
{
    (void)state;
    glint_camera camera = {.yfov = 1};
    const glint_vec3 eye = {1, 2, 3}, target = {4, 2, -1};
    assert_true(glint_camera_look(eye, target, (glint_vec3){0, 5, 0}, &camera));
    assert_right_handed(&camera);
    assert_vector(camera.eye, 1, 2, 3);
    assert_vector(camera.back, -0.6, 0, 0.8);
    assert_vector(camera.up, 0, 1, 0);
    // Up may be at any angle to the view.
    assert_true(glint_camera_look(eye, target, (glint_vec3){3, 5, -4}, &camera));
    assert_vector(camera.up, 0, 1, 0);
    assert_true(camera.yfov == 1);
}

static void a_camera_that_has_no_direction_stays(void **state)
{
    (void)state;
    const glint_camera before = {.yfov = 1, .eye = {7, 8, 9}};
    glint_camera camera = before;
    const glint_vec3 eye = {1, 2, 3}, below = {1, -5, 3}, up = {0, 1, 0};
    assert_false(glint_camera_look(eye, eye, up, &camera));
    assert_false(glint_camera_look(eye, below, up, &camera));
    assert_false(glint_camera_look(eye, below, (glint_vec3){0, -1e-300, 0}, &camera));
    assert_false(glint_camera_look(eye, (glint_vec3){0, 0, 0}, (glint_vec3){0, 0, 0}, &camera));
    assert_false(glint_camera_look(eye, (glint_vec3){NAN, 0, 0}, up, &camera));
    assert_false(glint_camera_look((glint_vec3){INFINITY, 0, 0}, eye, up, &camera));
    assert_memory_equal(&camera, &before, sizeof camera);
}

static void a_raised_camera_keeps_compass_and_distance(void **state)
{
    (void)state;
    const glint_vec3 centre = {1, 2, 3};
    const double compass[2] = {0.6, 0.8};
    for (int degrees = -90; degrees <= 90; degrees += 15) {
        // Rolled, and looking elsewhere at first.
        glint_camera camera = {.yfov = 1};
        assert_true(glint_camera_look((glint_vec3){1 + 3 * compass[0], 6, 3 + 3 * compass[1]},
                                      (glint_vec3){9, 9, 9}, (glint_vec3){1, 1, 0}, &camera));
        glint_camera_raise(centre, degrees * GLINT_PI / 180, &camera);
        assert_right_handed(&camera);
        const double high = sin(degrees * GLINT_PI / 180), far = cos(degrees * GLINT_PI / 180);
        assert_vector(camera.back, far * compass[0], high, far * compass[1]);
        assert_vector(camera.eye, 1 + 5 * far * compass[0], 2 + 5 * high, 3 + 5 * far * compass[1]);
        assert_near(camera.right.y, 0);
        assert_true(camera.up.y >= 0);
    }
}

// Straight above or below the centre, the camera's up direction tells from which side it
// came.
static void a_camera_on_the_axis_is_raised_by_its_picture(void **state)
{
    (void)state;
    const glint_vec3 centre = {0, 0, 0};
    for (int side = -1; side <= 1; side += 2) {
        glint_camera camera = {.yfov = 1};
        assert_true(glint_camera_look((glint_vec3){0, 2 * side, 0}, centre,
                                      (glint_vec3){-1.0 * side, 0, 0}, &camera));
        glint_camera_raise(centre, 0, &camera);
        assert_vector(camera.eye, 2, 0, 0);
        assert_vector(camera.up, 0, 1, 0);
    }
}

static void quarter_turns_are_exact(void **state)
{
    (void)state;
    const glint_camera camera = {
        .yfov = 1, .eye = {0.1, 0.2, 0.7}, .right = {1, 0, 0}, .up = {0, 1, 0}, .back = {0, 0, 1}};
    const glint_vec3 centre = {0, 0, 0};
    // Counter-clockwise from above: an object before the scene moves to its right.
    static const double eyes[4][3] = {
        {0.1, 0.2, 0.7}, {0.7, 0.2, -0.1}, {-0.1, 0.2, -0.7}, {-0.7, 0.2, 0.1}};
    for (int quarter = 0; quarter < 4; quarter++) {
        for (int64_t steps = 4; steps <= 1000; steps += 4) {
            const glint_camera turned =
                glint_camera_orbit(&camera, centre, quarter * (steps / 4), steps);
            assert_true(turned.eye.x == eyes[quarter][0]);
            assert_true(turned.eye.y == eyes[quarter][1]);
            assert_true(turned.eye.z == eyes[quarter][2]);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_identity_looks_along_minus_z),
        cmocka_unit_test(scale_and_shear_leave_axes_orthonormal),
        cmocka_unit_test(a_mirrored_node_does_not_mirror_the_picture),
        cmocka_unit_test(singular_matrices_make_no_camera),
        cmocka_unit_test(the_default_camera_holds_the_bounding_sphere),
        cmocka_unit_test(without_a_box_the_default_camera_looks_from_plus_z),
        cmocka_unit_test(cameras_are_chosen_by_name_then_by_index),
        cmocka_unit_test(the_list_of_many_cameras_is_cut),
        cmocka_unit_test(a_scene_without_cameras_is_framed),
        cmocka_unit_test(a_turntable_goes_round_its_centre),
        cmocka_unit_test(a_camera_looks_at_its_target),
        cmocka_unit_test(a_camera_that_has_no_direction_stays),
        cmocka_unit_test(a_raised_camera_keeps_compass_and_distance),
        cmocka_unit_test(a_camera_on_the_axis_is_raised_by_its_picture),
        cmocka_unit_test(quarter_turns_are_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
