// Tests the matrices in a frame's file against the definition of the camera.
#include "report/frame/frame_metadata.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

// The matrices are stored as float; the projected points are of magnitude 1.
#define TOLERANCE 2e-5

static uint32_t random_state = 1;

static double random_between(double low, double high)
{
    random_state = random_state * 1664525u + 1013904223u;
    return low + (high - low) * (random_state >> 8) / 16777216.0;
}

static glint_camera random_camera(bool orthographic)
{
    glint_vec3 back = glint_vec3_normalize(
        (glint_vec3){random_between(-1, 1), random_between(-1, 1), random_between(0.1, 1)});
    glint_vec3 right = glint_vec3_normalize(glint_vec3_cross((glint_vec3){0, 1, 0}, back));
    return (glint_camera){
        .orthographic = orthographic,
        .yfov = random_between(0.2, 2),
        .ymag = random_between(0.5, 2),
        .eye = {random_between(-3, 3), random_between(-3, 3), random_between(-3, 3)},
        .right = right,
        .up = glint_vec3_cross(back, right),
        .back = back,
    };
}

// The point at `depth` in front of the camera, seen at (u, v) of the image. (0, 0) is the upper
// left corner.
static glint_vec3 point_seen_at(const glint_camera *camera, double aspect, double u, double v,
                                double depth)
{
    double half = camera->orthographic ? camera->ymag : depth * tan(camera->yfov / 2);
    glint_vec3 p = glint_vec3_subtract(camera->eye, glint_vec3_scale(camera->back, depth));
    p = glint_vec3_add(p, glint_vec3_scale(camera->right, (2 * u - 1) * aspect * half));
    return glint_vec3_add(p, glint_vec3_scale(camera->up, (1 - 2 * v) * half));
}

static void transform(glint_vec3 p, const float m[16], double result[4])
{
    const double row[4] = {p.x, p.y, p.z, 1};
    for (int column = 0; column < 4; column++) {
        result[column] = 0;
        for (int i = 0; i < 4; i++) {
            result[column] += row[i] * (double)m[4 * i + column];
        }
    }
}

static void ndc_is_the_place_in_the_image(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        glint_camera camera = random_camera(i % 2 == 1);
        double aspect = random_between(0.3, 3);
        double u = random_between(0, 1);
        double v = random_between(0, 1);
        glint_vec3 p = point_seen_at(&camera, aspect, u, v, random_between(1, 5));
        float matrix[16];
        double q[4];
        glint_world_to_ndc(&camera, aspect, matrix);
        transform(p, matrix, q);
        assert_true(fabs(q[0] / q[3] - u) < TOLERANCE);
        assert_true(fabs(q[1] / q[3] - v) < TOLERANCE);
    }
}

static void camera_space_looks_along_positive_z(void **state)
{
    (void)state;
    for (int i = 0; i < 1000; i++) {
        glint_camera camera = random_camera(i % 2 == 1);
        double depth = random_between(1, 5);
        float matrix[16];
        double q[4];
        glint_world_to_camera(&camera, matrix);
        transform(point_seen_at(&camera, 1, 0.75, 0.25, depth), matrix, q);
        assert_true(fabs(q[2] - depth) < TOLERANCE);
        assert_true(q[0] > 0 && q[1] > 0 && fabs(q[0] - q[1]) < TOLERANCE);
        assert_true(fabs(q[3] - 1) < TOLERANCE);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ndc_is_the_place_in_the_image),
        cmocka_unit_test(camera_space_looks_along_positive_z),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
