// Tests cameras that move until a scene fills the frame. The test projects every vertex itself.
#include "scene/fit.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define TRIANGLES 60
#define POINTS (3 * TRIANGLES)

static const double aspects[] = {0.3, 1, 16.0 / 9, 4};
#define ASPECTS (int)(sizeof aspects / sizeof aspects[0])

static uint32_t seed;

static double random_within(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * (double)(seed >> 8) / 0x1p24;
}

// A cloud of vertices, longer along x. The stored coordinates have an origin and a unit.
static glint_scene make_cloud(float positions[3 * POINTS])
{
    glint_scene scene = {
        .origin = {3, -7, 1e3}, .unit = 0.25, .positions = positions, .triangle_count = TRIANGLES};
    for (int i = 0; i < POINTS; i++) {
        positions[3 * i] = (float)random_within(-1, 1);
        positions[3 * i + 1] = (float)random_within(-0.4, 0.3);
        positions[3 * i + 2] = (float)random_within(-0.5, 0.5);
    }
    glint_scene_find_bounds(&scene);
    return scene;
}

static glint_camera make_camera(bool orthographic)
{
    const double yfov = random_within(0.05, 1);
    const glint_vec3 target = {random_within(-9, 9), random_within(-9, 9), random_within(-9, 9)};
    const glint_vec3 up = {random_within(-1, 1), 1, random_within(-1, 1)};
    glint_camera camera = {.orthographic = orthographic, .yfov = yfov, .ymag = 1};
    assert_true(glint_camera_look((glint_vec3){20, 10, -30}, target, up, &camera));
    return camera;
}

static glint_vec3 vertex(const glint_scene *scene, int i)
{
    const float *p = scene->positions + (ptrdiff_t)3 * i;
    return (glint_vec3){scene->origin.x + (double)p[0] * scene->unit,
                        scene->origin.y + (double)p[1] * scene->unit,
                        scene->origin.z + (double)p[2] * scene->unit};
}

// Places of points in the picture: −1 to 1 within the frame, upwards and to the right.
typedef struct shown {
    double left, right, low, high, nearest;
} shown;

static void show(const glint_camera *camera, double aspect, glint_vec3 point, shown *all)
{
    const glint_vec3 d = {point.x - camera->eye.x, point.y - camera->eye.y,
                          point.z - camera->eye.z};
    const double depth = -(d.x * camera->back.x + d.y * camera->back.y + d.z * camera->back.z);
    const double half = camera->orthographic ? camera->ymag : depth * tan(camera->yfov / 2);
    const double x = (d.x * camera->right.x + d.y * camera->right.y + d.z * camera->right.z);
    const double y = (d.x * camera->up.x + d.y * camera->up.y + d.z * camera->up.z);
    all->left = fmin(all->left, x / half / aspect);
    all->right = fmax(all->right, x / half / aspect);
    all->low = fmin(all->low, y / half);
    all->high = fmax(all->high, y / half);
    all->nearest = fmin(all->nearest, depth);
}

static const shown nothing = {INFINITY, -INFINITY, INFINITY, -INFINITY, INFINITY};

static shown show_vertices(const glint_camera *camera, double aspect, const glint_scene *scene)
{
    shown all = nothing;
    for (int i = 0; i < POINTS; i++) {
        show(camera, aspect, vertex(scene, i), &all);
    }
    return all;
}

static void assert_near(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance)) {
        fail_msg("%.17g is not %.17g", value, wanted);
    }
}

// All points are within the frame and touch two opposite edges. The eye is rounded to doubles of
// 1e3.
static void assert_fills(const shown *all)
{
    const double rounding = 1e-9;
    const double across = fmax(-all->left, all->right), along = fmax(-all->low, all->high);
    assert_true(all->nearest > 0);
    assert_near(fmax(across, along), 1, rounding);
    if (across > along) {
        assert_near(-all->left, all->right, rounding);
    } else {
        assert_near(-all->low, all->high, rounding);
    }
}

static void every_vertex_is_in_and_two_edges_are_touched(void **state)
{
    (void)state;
    seed = 1;
    for (int round = 0; round < 50 * ASPECTS; round++) {
        float positions[3 * POINTS];
        const glint_scene scene = make_cloud(positions);
        const double aspect = aspects[round % ASPECTS];
        glint_camera camera = make_camera(round % 5 == 0);
        const glint_camera before = camera;
        const glint_fit fit = {
            .scene = &scene, .low = scene.low, .high = scene.high, .aspect = aspect};
        glint_camera_fit(&fit, &camera);
        const shown all = show_vertices(&camera, aspect, &scene);
        assert_fills(&all);
        assert_memory_equal(&camera.right, &before.right, 3 * sizeof(glint_vec3));
        assert_true(camera.yfov == before.yfov);
    }
}

static void the_loose_edges_are_equally_far(void **state)
{
    (void)state;
    seed = 2;
    for (int round = 0; round < 50; round++) {
        float positions[3 * POINTS];
        const glint_scene scene = make_cloud(positions);
        glint_camera camera = make_camera(true);
        const glint_fit fit = {.scene = &scene, .low = scene.low, .high = scene.high, .aspect = 2};
        glint_camera_fit(&fit, &camera);
        const shown all = show_vertices(&camera, 2, &scene);
        assert_near(-all.left, all.right, 1e-9);
        assert_near(-all.low, all.high, 1e-9);
    }
}

static void a_margin_stays_free(void **state)
{
    (void)state;
    seed = 7;
    for (int round = 0; round < 20 * ASPECTS; round++) {
        float positions[3 * POINTS];
        const glint_scene scene = make_cloud(positions);
        const double aspect = aspects[round % ASPECTS];
        glint_camera camera = make_camera(round % 3 == 0);
        const glint_fit fit = {
            .scene = &scene, .low = scene.low, .high = scene.high, .aspect = aspect, .margin = 0.1};
        glint_camera_fit(&fit, &camera);
        shown all = show_vertices(&camera, aspect, &scene);
        all.left /= 0.9;
        all.right /= 0.9;
        all.low /= 0.9;
        all.high /= 0.9;
        assert_fills(&all);
    }
}

static void a_fitted_camera_stays_where_it_is(void **state)
{
    (void)state;
    seed = 3;
    for (int round = 0; round < 20; round++) {
        float positions[3 * POINTS];
        const glint_scene scene = make_cloud(positions);
        glint_camera camera = make_camera(round % 2 == 0);
        const glint_fit fit = {
            .scene = &scene, .low = scene.low, .high = scene.high, .aspect = 1.5};
        glint_camera_fit(&fit, &camera);
        const glint_camera once = camera;
        glint_camera_fit(&fit, &camera);
        assert_memory_equal(&camera, &once, sizeof camera);
    }
}

static void what_moves_is_fitted_by_the_corners_of_its_box(void **state)
{
    (void)state;
    seed = 4;
    for (int round = 0; round < 10 * ASPECTS; round++) {
        const glint_vec3 low = {-1, 2, -3}, high = {4, 2.5, 0};
        const glint_scene scene = {.unit = 1};
        const double aspect = aspects[round % ASPECTS];
        glint_camera camera = make_camera(round % 3 == 0);
        const glint_fit fit = {
            .scene = &scene, .as_box = true, .low = low, .high = high, .aspect = aspect};
        glint_camera_fit(&fit, &camera);
        shown all = nothing;
        for (int i = 0; i < 8; i++) {
            show(&camera, aspect,
                 (glint_vec3){i % 2 == 0 ? -1 : 4, i / 2 % 2 == 0 ? 2 : 2.5, i < 4 ? -3 : 0}, &all);
        }
        assert_fills(&all);
    }
}

// In 720 positions no vertex leaves the frame, and one vertex nearly touches an edge.
static void what_turns_fits_in_every_position(void **state)
{
    (void)state;
    seed = 5;
    for (int round = 0; round < 6 * ASPECTS; round++) {
        float positions[3 * POINTS];
        const glint_scene scene = make_cloud(positions);
        const double aspect = aspects[round % ASPECTS];
        glint_camera camera = make_camera(round % 3 == 0);
        const glint_fit fit = {
            .scene = &scene, .low = scene.low, .high = scene.high, .turns = true, .aspect = aspect};
        glint_camera_fit(&fit, &camera);
        const double x = (scene.low.x + scene.high.x) / 2, z = (scene.low.z + scene.high.z) / 2;
        shown all = nothing;
        for (int i = 0; i < POINTS * 720; i++) {
            const glint_vec3 p = vertex(&scene, i / 720);
            const double angle = i % 720 * GLINT_PI / 360, c = cos(angle), s = sin(angle);
            const glint_vec3 turned = {x + (p.x - x) * c + (p.z - z) * s, p.y,
                                       z + (p.z - z) * c - (p.x - x) * s};
            show(&camera, aspect, turned, &all);
        }
        const double most = fmax(fmax(-all.left, all.right), fmax(-all.low, all.high));
        assert_true(most <= 1 + 1e-9 && most > 1 - 2e-4);
    }
}

static void a_spike_does_not_touch_the_eye(void **state)
{
    (void)state;
    // Narrower than the field of view, and along the axis of view.
    float positions[] = {0, 0, 1, -0.1f, 0, -1, 0.1f, 0, -1};
    glint_scene scene = {.unit = 1, .positions = positions, .triangle_count = 1};
    glint_scene_find_bounds(&scene);
    glint_camera camera = {.yfov = 2};
    assert_true(glint_camera_look((glint_vec3){0, 0, 9}, (glint_vec3){0, 0, 0},
                                  (glint_vec3){0, 1, 0}, &camera));
    const glint_fit fit = {.scene = &scene, .low = scene.low, .high = scene.high, .aspect = 1};
    glint_camera_fit(&fit, &camera);
    assert_near(camera.eye.z, 1 + 0.01 * hypot(0.1, 1), 1e-6);
    assert_near(camera.eye.x, 0, 1e-9);
}

// Seen along (1, 1, 1), the middle of this triangle's box lies behind its corners. At wide angles
// no edge is touched then: only the nearest corner limits the camera's distance.
static void wide_angles_move_the_camera_as_well(void **state)
{
    (void)state;
    float corners[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const glint_scene scene = {.unit = 1, .positions = corners, .triangle_count = 1};
    for (int degrees = 100; degrees < 180; degrees += 10) {
        glint_camera camera = {.yfov = degrees * 3.14159265358979 / 180};
        assert_true(glint_camera_look((glint_vec3){9, 9, 9}, (glint_vec3){0, 0, 0},
                                      (glint_vec3){0, 1, 0}, &camera));
        const glint_fit fit = {.scene = &scene, .low = {0, 0, 0}, .high = {1, 1, 1}, .aspect = 1};
        glint_camera_fit(&fit, &camera);
        shown all = nothing;
        for (int k = 0; k < 3; k++) {
            show(&camera, 1,
                 (glint_vec3){(double)corners[3 * k], (double)corners[3 * k + 1],
                              (double)corners[3 * k + 2]},
                 &all);
        }
        const double most = fmax(fmax(-all.left, all.right), fmax(-all.low, all.high));
        assert_true(all.nearest > 0 && most <= 1 + 1e-9);
        assert_true(camera.eye.x < 2); // the camera moved
    }
}

static void without_points_the_camera_stays(void **state)
{
    (void)state;
    seed = 6;
    const glint_camera before = make_camera(false);
    glint_camera camera = before;
    const glint_scene scene = {0};
    const glint_fit none = {.scene = &scene,
                            .low = {INFINITY, INFINITY, INFINITY},
                            .high = {-INFINITY, -INFINITY, -INFINITY},
                            .aspect = 1};
    glint_camera_fit(&none, &camera);
    assert_memory_equal(&camera, &before, sizeof camera);
    glint_fit box = none;
    box.as_box = true;
    glint_camera_fit(&box, &camera);
    assert_memory_equal(&camera, &before, sizeof camera);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_vertex_is_in_and_two_edges_are_touched),
        cmocka_unit_test(the_loose_edges_are_equally_far),
        cmocka_unit_test(a_margin_stays_free),
        cmocka_unit_test(a_fitted_camera_stays_where_it_is),
        cmocka_unit_test(what_moves_is_fitted_by_the_corners_of_its_box),
        cmocka_unit_test(what_turns_fits_in_every_position),
        cmocka_unit_test(a_spike_does_not_touch_the_eye),
        cmocka_unit_test(wide_angles_move_the_camera_as_well),
        cmocka_unit_test(without_points_the_camera_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
