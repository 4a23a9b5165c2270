// Tests each material's share of the picture against areas in closed form.
#include "scene/shape/shares.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define PI 3.14159265358979323846

// Shares count a grid of 64 rows. The edges of a shape lie between its rays, so a row at each edge
// may count or not.
#define ROW (1.0 / 64)

// A rectangle around a point, across the view of a camera that looks along −z.
static void add_rectangle(float *positions, glint_vec3 middle, double half_width,
                          double half_height)
{
    static const double corners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    for (int i = 0; i < 6; i++) {
        positions[3 * i] = (float)(middle.x + corners[i][0] * half_width);
        positions[3 * i + 1] = (float)(middle.y + corners[i][1] * half_height);
        positions[3 * i + 2] = (float)middle.z;
    }
}

static const glint_camera looking_along = {
    .yfov = PI / 2, .ymag = 1, .right = {1, 0, 0}, .up = {0, 1, 0}, .back = {0, 0, 1}};

// Two rectangles of materials 0 and 1. The first partly hides the second.
static glint_scene make_two(float positions[36], uint32_t materials[4])
{
    add_rectangle(positions, (glint_vec3){-1, 0, -4}, 1, 1);
    add_rectangle(positions + 18, (glint_vec3){0, 0, -8}, 4, 2);
    for (int i = 0; i < 4; i++) {
        materials[i] = i < 2 ? 0 : 1;
    }
    return (glint_scene){.unit = 1,
                         .positions = positions,
                         .material_of = materials,
                         .triangle_count = 4,
                         .material_count = 3};
}

static void nearer_surfaces_hide_others(void **state)
{
    (void)state;
    float positions[36];
    uint32_t materials[4];
    const glint_scene scene = make_two(positions, materials);
    double shares[3];
    assert_true(glint_material_shares(&scene, &looking_along, 2, shares));
    // The picture is 4 × 2 at 1 metre. The first rectangle is 1/2 × 1/2 there, the second 1 × 1/2.
    assert_true(fabs(shares[0] - 0.25 / 8) < 2 * ROW * 0.25);
    assert_true(fabs(shares[1] - (0.5 - 0.25) / 8) < 2 * ROW * 0.5);
    assert_true(shares[2] <= 0);
}

static void parallel_rays_see_sizes(void **state)
{
    (void)state;
    float positions[36];
    uint32_t materials[4];
    const glint_scene scene = make_two(positions, materials);
    glint_camera camera = looking_along;
    camera.orthographic = true;
    camera.ymag = 5;
    double shares[3];
    assert_true(glint_material_shares(&scene, &camera, 1, shares));
    assert_true(fabs(shares[0] - 4.0 / 100) < ROW * 0.4);
    assert_true(fabs(shares[1] - (32.0 - 4.0) / 100) < ROW * 2.4);
    camera.eye.z = -6; // the first is behind it
    assert_true(glint_material_shares(&scene, &camera, 1, shares));
    assert_true(shares[0] <= 0);
    assert_true(fabs(shares[1] - 32.0 / 100) < ROW * 2.4);
}

// A floor that extends behind the eye fills the lower half, up to the horizon.
static void a_floor_reaches_behind_the_eye(void **state)
{
    (void)state;
    float floor[18] = {-1e6F, -1, 1e6F, 1e6F, -1, 1e6F,  1e6F,  -1, -1e6F,
                       -1e6F, -1, 1e6F, 1e6F, -1, -1e6F, -1e6F, -1, -1e6F};
    uint32_t materials[2] = {0, 0};
    const glint_scene scene = {.unit = 1,
                               .positions = floor,
                               .material_of = materials,
                               .triangle_count = 2,
                               .material_count = 1};
    double shares[1];
    assert_true(glint_material_shares(&scene, &looking_along, 1.5, shares));
    assert_true(fabs(shares[0] - 0.5) < 1e-12);
    glint_camera away = looking_along;
    away.up.y = away.back.z = -1; // turned about x
    assert_true(glint_material_shares(&scene, &away, 1.5, shares));
    assert_true(fabs(shares[0] - 0.5) < 1e-12);
    away = looking_along;
    away.eye.y = -1; // the eye is in its plane
    assert_true(glint_material_shares(&scene, &away, 1.5, shares));
    assert_true(shares[0] <= 0);
}

static void stored_positions_have_origin_and_unit(void **state)
{
    (void)state;
    float positions[36];
    uint32_t materials[4];
    glint_scene scene = make_two(positions, materials);
    double plain[3], moved[3];
    assert_true(glint_material_shares(&scene, &looking_along, 2, plain));
    scene.origin = (glint_vec3){64, -32, 1024};
    scene.unit = 8;
    glint_camera camera = looking_along;
    camera.eye = scene.origin;
    assert_true(glint_material_shares(&scene, &camera, 2, moved));
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(plain[i] - moved[i]) < 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearer_surfaces_hide_others),
        cmocka_unit_test(parallel_rays_see_sizes),
        cmocka_unit_test(a_floor_reaches_behind_the_eye),
        cmocka_unit_test(stored_positions_have_origin_and_unit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
