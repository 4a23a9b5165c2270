// Tests the primary rays that the host hands to the kernel.
#include "render/view.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const glint_stored_space unit_space = {.unit = 1, .low = {-1, -1, -1}, .high = {1, 1, 1}};

static glint_settings square_frame(void)
{
    glint_settings settings = glint_settings_default;
    settings.width = 100;
    settings.height = 100;
    return settings;
}

static glint_camera looking_along_minus_z(double z)
{
    return (glint_camera){
        .yfov = 0.7, .eye = {0.1, 0.2, z}, .right = {1, 0, 0}, .up = {0, 1, 0}, .back = {0, 0, 1}};
}

static double joined(const glint_split_vector *v, int k)
{
    return (double)v->high[k] + (double)v->low[k];
}

// Coordinate k of the ray at X = x, Y = y, at view depth `depth` beyond its start.
static double ray_at(const glint_frame_record *r, double x, double y, double depth, int k)
{
    double origin =
        joined(&r->origin, k) + x * joined(&r->origin_x, k) + y * joined(&r->origin_y, k);
    double direction =
        joined(&r->direction, k) + x * joined(&r->direction_x, k) + y * joined(&r->direction_y, k);
    return origin + depth * direction;
}

// A regression test: an optimiser once dropped the rounding between the halves, and the low halves
// were 0.
static void both_halves_of_a_split_vector_are_kept(void **state)
{
    (void)state;
    glint_camera camera = looking_along_minus_z(0.3);
    // A rotation by an angle without an exact sine and cosine in float.
    camera.right = (glint_vec3){cos(0.1), sin(0.1), 0};
    camera.up = (glint_vec3){-sin(0.1), cos(0.1), 0};
    glint_settings settings = square_frame();
    const glint_plan plan = {.depth = 1};
    glint_frame_record record;
    glint_view_record(&unit_space, &camera, &settings, &plan, &record);
    const double eye[3] = {0.1, 0.2, 0.3};
    double step = 2 * tan(0.35) / 100;
    const double right[3] = {step * cos(0.1), step * sin(0.1), 0};
    const double up[3] = {-step * sin(0.1), step * cos(0.1), 0};
    for (int k = 0; k < 3; k++) {
        // Two floats hold 48 bits.
        assert_true(fabs(joined(&record.origin, k) - eye[k]) <= 0x1p-48);
        assert_true(fabs(joined(&record.direction_x, k) - right[k]) <= 0x1p-48);
        assert_true(fabs(joined(&record.direction_y, k) - up[k]) <= 0x1p-48);
    }
}

static void rays_start_before_the_scene_and_on_the_same_lines(void **state)
{
    (void)state;
    static const double distances[] = {0, 0.5, 3, 1e3, 1e7};
    for (size_t i = 0; i < sizeof distances / sizeof *distances; i++) {
        double z = distances[i];
        glint_camera camera = looking_along_minus_z(z);
        camera.yfov = z > 3 ? 2 / z : 0.7;
        glint_settings settings = square_frame();
        const glint_plan plan = {.depth = 1};
        glint_frame_record r;
        glint_view_record(&unit_space, &camera, &settings, &plan, &r);
        double start = (double)r.start[0] + (double)r.start[1];
        assert_true(start >= 0 && start <= fmax(0, z - 1));
        assert_true(z < 2 || start > z - 1.1 - 1e-5 * z);
        // The ray through the corner (50, −50), at the far plane of the scene.
        double half = tan(camera.yfov / 2), depth = z + 1 - start;
        double tolerance = 1e-13 * (z + 1);
        assert_true(fabs(ray_at(&r, 50, -50, depth, 0) - (0.1 + half * (z + 1))) <= tolerance);
        assert_true(fabs(ray_at(&r, 50, -50, depth, 1) - (0.2 - half * (z + 1))) <= tolerance);
        assert_true(fabs(ray_at(&r, 50, -50, depth, 2) + 1) <= tolerance);
    }
}

static void parallel_rays_share_their_direction(void **state)
{
    (void)state;
    glint_camera camera = looking_along_minus_z(5);
    camera.orthographic = true;
    camera.ymag = 2;
    glint_settings settings = square_frame();
    const glint_plan plan = {.depth = 1};
    glint_frame_record r;
    glint_view_record(&unit_space, &camera, &settings, &plan, &r);
    for (int k = 0; k < 3; k++) {
        assert_true(joined(&r.direction_x, k) == 0 && joined(&r.direction_y, k) == 0);
        assert_true(joined(&r.direction, k) == (k == 2 ? -1 : 0));
    }
    assert_true(fabs(ray_at(&r, 50, 0, 0, 0) - 2.1) < 1e-12);
    assert_true(fabs(ray_at(&r, 0, 50, 0, 1) - 2.2) < 1e-12);
}

static void units_and_origin_of_the_scene_do_not_move_the_rays(void **state)
{
    (void)state;
    const glint_stored_space far_away = {.origin = {1e6, -2e6, 3e6},
                                         .unit = 0x1p-10,
                                         .low = {1e6, -2e6, 3e6},
                                         .high = {1e6 + 1e-3, -2e6 + 1e-3, 3e6 + 1e-3}};
    glint_camera camera = looking_along_minus_z(0);
    camera.eye = (glint_vec3){1e6, -2e6, 3e6 + 0x1p-9};
    glint_settings settings = square_frame();
    const glint_plan plan = {.depth = 1};
    glint_frame_record r;
    glint_view_record(&far_away, &camera, &settings, &plan, &r);
    double start = (double)r.start[0] + (double)r.start[1];
    assert_true(fabs(ray_at(&r, 0, 0, -start, 0)) < 1e-9);
    assert_true(fabs(ray_at(&r, 0, 0, -start, 2) - 2) < 1e-9); // two stored units from the origin
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_halves_of_a_split_vector_are_kept),
        cmocka_unit_test(rays_start_before_the_scene_and_on_the_same_lines),
        cmocka_unit_test(parallel_rays_share_their_direction),
        cmocka_unit_test(units_and_origin_of_the_scene_do_not_move_the_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
