// Tests proofs about surfaces: open or closed, convex or not, nested or not.
#include "scene/shape/topology.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

// A growing scene of bare triangles; every mesh is an instance.
typedef struct mesh_builder {
    glint_scene scene;
    size_t capacity;
} mesh_builder;

static void begin_instance(mesh_builder *builder, uint32_t material)
{
    glint_scene *scene = &builder->scene;
    scene->instances =
        realloc(scene->instances, (scene->instance_count + 1) * sizeof *scene->instances);
    assert_non_null(scene->instances);
    scene->instances[scene->instance_count++] =
        (glint_instance){.first_triangle = scene->triangle_count, .material = material};
}

static void add(mesh_builder *builder, glint_vec3 a, glint_vec3 b, glint_vec3 c)
{
    glint_scene *scene = &builder->scene;
    if (scene->triangle_count == builder->capacity) {
        builder->capacity = builder->capacity ? 2 * builder->capacity : 64;
        scene->positions = realloc(scene->positions, builder->capacity * 9 * sizeof(float));
        assert_non_null(scene->positions);
    }
    const glint_vec3 corners[3] = {a, b, c};
    float *p = scene->positions + 9 * scene->triangle_count++;
    for (int i = 0; i < 3; i++) {
        *p++ = (float)corners[i].x;
        *p++ = (float)corners[i].y;
        *p++ = (float)corners[i].z;
    }
    scene->instances[scene->instance_count - 1].triangle_count++;
}

static void add_quad(mesh_builder *builder, const glint_vec3 *v, const int *corners)
{
    add(builder, v[corners[0]], v[corners[1]], v[corners[2]]);
    add(builder, v[corners[0]], v[corners[2]], v[corners[3]]);
}

// Rotates by arbitrary angles, so that no coordinate is exact. (0, 0) does not rotate.
static glint_vec3 turned(glint_vec3 p, double yaw, double pitch)
{
    glint_vec3 q = {cos(yaw) * p.x + sin(yaw) * p.z, p.y, -sin(yaw) * p.x + cos(yaw) * p.z};
    return (glint_vec3){q.x, cos(pitch) * q.y - sin(pitch) * q.z,
                        sin(pitch) * q.y + cos(pitch) * q.z};
}

static void add_box(mesh_builder *builder, glint_vec3 center, double half, double yaw)
{
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    glint_vec3 v[8];
    for (int i = 0; i < 8; i++) {
        glint_vec3 p = {i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half};
        v[i] = glint_vec3_add(center, turned(p, yaw, 1.7 * yaw));
    }
    for (int f = 0; f < 6; f++) {
        add_quad(builder, v, faces[f]);
    }
}

// A point of a latitude-longitude grid over a body of revolution like a sphere. The profile gives
// radius and height by a parameter in [0, 1].
typedef glint_vec3 (*profile)(double t, double azimuth);

static glint_vec3 sphere(double t, double azimuth)
{
    double r = 0.7 * sin(GLINT_PI * t);
    return (glint_vec3){r * cos(azimuth), 0.7 * -cos(GLINT_PI * t), -r * sin(azimuth)};
}

// A bowl: the outside of a sphere of 0.9, and the inside of a sphere of 0.6 with a higher centre.
static glint_vec3 bowl(double t, double azimuth)
{
    double angle = t < 0.5 ? GLINT_PI * t : GLINT_PI * (1 - t);
    double radius = t < 0.5 ? 0.9 : 0.6;
    double r = radius * sin(angle);
    return (glint_vec3){r * cos(azimuth), -radius * cos(angle), -r * sin(azimuth)};
}

static void add_revolved(mesh_builder *builder, profile at, int rings, int sectors)
{
    for (int i = 0; i < rings; i++) {
        for (int j = 0; j < sectors; j++) {
            // The grid closes with the same azimuth and poles, bit for bit.
            double t0 = (double)i / rings;
            double t1 = (double)(i + 1) / rings;
            double a0 = 2 * GLINT_PI * j / sectors;
            double a1 = 2 * GLINT_PI * ((j + 1) % sectors) / sectors;
            glint_vec3 south = at(0, 0);
            glint_vec3 north = at(1, 0);
            glint_vec3 p00 = i == 0 ? south : at(t0, a0);
            glint_vec3 p01 = i == 0 ? south : at(t0, a1);
            glint_vec3 p10 = i == rings - 1 ? north : at(t1, a0);
            glint_vec3 p11 = i == rings - 1 ? north : at(t1, a1);
            if (i > 0) {
                add(builder, p00, p01, p11);
            }
            if (i < rings - 1) {
                add(builder, p00, p11, p10);
            }
        }
    }
}

static glint_topology find(mesh_builder *builder)
{
    glint_topology topology;
    glint_error error = {0};
    assert_int_equal(glint_topology_find(&builder->scene, &topology, &error), GLINT_OK);
    return topology;
}

static void free_all(mesh_builder *builder, glint_topology *topology)
{
    free(builder->scene.positions);
    free(builder->scene.instances);
    *builder = (mesh_builder){0};
    glint_topology_free(topology);
}

static void boxes_are_convex_however_they_are_turned(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        mesh_builder builder = {0};
        begin_instance(&builder, 0);
        add_box(&builder, (glint_vec3){0.01 * i, -0.3, 0.2}, 0.4, 0.37 * i);
        glint_topology topology = find(&builder);
        assert_int_equal(topology.component_count, 1);
        assert_int_equal(topology.components[0].triangle_count, 12);
        assert_true(topology.components[0].closed);
        assert_true(topology.components[0].convex);
        assert_int_equal(topology.boundary_edges, 0);
        free_all(&builder, &topology);
    }
}

static void a_missing_triangle_leaves_three_boundary_edges(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0, 0, 0}, 0.5, 0.4);
    builder.scene.triangle_count--;
    builder.scene.instances[0].triangle_count--;
    glint_topology topology = find(&builder);
    assert_int_equal(topology.component_count, 1);
    assert_int_equal(topology.components[0].boundary_edges, 3);
    assert_false(topology.components[0].closed);
    assert_false(topology.components[0].convex);
    free_all(&builder, &topology);
}

static void a_turned_over_triangle_is_a_boundary(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0, 0, 0}, 0.5, 0);
    float *p = builder.scene.positions;
    for (int k = 0; k < 3; k++) {
        float swap = p[3 + k];
        p[3 + k] = p[6 + k];
        p[6 + k] = swap;
    }
    glint_topology topology = find(&builder);
    assert_int_equal(topology.boundary_edges, 3);
    assert_false(topology.components[0].convex);
    free_all(&builder, &topology);
}

static void a_body_inside_out_is_closed_and_not_convex(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0, 0, 0}, -0.5, 0.3); // mirrored at its centre
    glint_topology topology = find(&builder);
    assert_true(topology.components[0].closed);
    assert_false(topology.components[0].convex);
    free_all(&builder, &topology);
}

static void spheres_are_convex_poles_and_all(void **state)
{
    (void)state;
    const int sizes[][2] = {{3, 3}, {8, 16}, {33, 64}, {200, 400}};
    for (int i = 0; i < 4; i++) {
        mesh_builder builder = {0};
        begin_instance(&builder, 0);
        add_revolved(&builder, sphere, sizes[i][0], sizes[i][1]);
        glint_topology topology = find(&builder);
        assert_int_equal(topology.component_count, 1);
        assert_true(topology.components[0].closed);
        assert_true(topology.components[0].convex);
        free_all(&builder, &topology);
    }
}

// In the finest bowls, each edge of the hollow bends by less than a rounding error could.
static void bowls_are_not_convex_however_fine(void **state)
{
    (void)state;
    const int sizes[][2] = {{8, 16}, {100, 200}, {1000, 2000}};
    for (int i = 0; i < 3; i++) {
        mesh_builder builder = {0};
        begin_instance(&builder, 0);
        add_revolved(&builder, bowl, sizes[i][0], sizes[i][1]);
        glint_topology topology = find(&builder);
        assert_int_equal(topology.component_count, 1);
        assert_true(topology.components[0].closed);
        assert_false(topology.components[0].convex);
        free_all(&builder, &topology);
    }
}

static void a_dent_far_above_rounding_is_seen(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_revolved(&builder, sphere, 16, 32);
    glint_vec3 from = sphere(0.5, 0);
    for (size_t i = 0; i < 3 * builder.scene.triangle_count; i++) {
        float *p = builder.scene.positions + 3 * i;
        if (p[0] == (float)from.x && p[1] == (float)from.y && p[2] == (float)from.z) {
            p[0] -= 0.02f;
        }
    }
    glint_topology topology = find(&builder);
    assert_true(topology.components[0].closed);
    assert_false(topology.components[0].convex);
    free_all(&builder, &topology);
}

// A bipyramid over a pentagram: closed, V − E + F = 2, and convex at every edge, but wound twice.
static void a_pentagrams_bipyramid_is_not_convex(void **state)
{
    (void)state;
    for (int step = 1; step <= 2; step++) {
        mesh_builder builder = {0};
        begin_instance(&builder, 0);
        glint_vec3 top = {0, 0.5, 0};
        glint_vec3 bottom = {0, -0.5, 0};
        glint_vec3 v[5];
        for (int i = 0; i < 5; i++) {
            double angle = 2 * GLINT_PI * step * i / 5;
            v[i] = (glint_vec3){0.8 * cos(angle), 0, -0.8 * sin(angle)};
        }
        for (int i = 0; i < 5; i++) {
            add(&builder, v[i], v[(i + 1) % 5], top);
            add(&builder, v[(i + 1) % 5], v[i], bottom);
        }
        glint_topology topology = find(&builder);
        assert_true(topology.components[0].closed);
        assert_int_equal(topology.components[0].convex, step == 1);
        free_all(&builder, &topology);
    }
}

static void a_flat_body_without_inside_is_not_convex(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    glint_vec3 a = {0, 0, 0};
    glint_vec3 b = {1, 0, 0};
    glint_vec3 c = {0, 1, 0};
    add(&builder, a, b, c);
    add(&builder, a, c, b);
    glint_topology topology = find(&builder);
    assert_true(topology.components[0].closed);
    assert_false(topology.components[0].convex);
    free_all(&builder, &topology);
}

static void components_keep_apart_by_instance_and_by_position(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0.5, 0, 0}, 0.1, 0);
    add_box(&builder, (glint_vec3){-0.5, 0, 0}, 0.1, 0);
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0.5, 0, 0}, 0.1, 0); // at the place of the first box
    glint_topology topology = find(&builder);
    assert_int_equal(topology.component_count, 3);
    assert_int_equal(topology.components[0].instance, 0);
    assert_true(topology.components[0].low[0] > 0.3f);
    assert_true(topology.components[1].high[0] < -0.3f);
    assert_int_equal(topology.components[2].instance, 1);
    free_all(&builder, &topology);
}

// Boxes in one mesh that share a vertex, an edge or a face are bodies of their own.
static void boxes_that_touch_are_apart(void **state)
{
    (void)state;
    static const glint_vec3 centers[] = {
        {-0.25, -0.25, -0.25}, {-0.25, -0.25, 0.25}, {-0.25, 0.25, 0.25}};
    for (int i = 0; i < 3; i++) {
        mesh_builder builder = {0};
        begin_instance(&builder, 0);
        add_box(&builder, (glint_vec3){0.25, 0.25, 0.25}, 0.25, 0);
        add_box(&builder, centers[i], 0.25, 0);
        glint_topology topology = find(&builder);
        assert_int_equal(topology.component_count, 2);
        for (int k = 0; k < 2; k++) {
            assert_true(topology.components[k].closed);
            assert_true(topology.components[k].simple);
            assert_true(topology.components[k].convex);
            assert_true(fabs(topology.components[k].volume - 0.125) < 1e-9);
        }
        free_all(&builder, &topology);
    }
}

// Eight cubes in a ring. Their common faces are left out, except between the last and the first.
static void a_ring_that_meets_itself_is_not_simple(void **state)
{
    (void)state;
    static const int cells[8][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    static const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    for (int c = 0; c < 8; c++) {
        glint_vec3 v[8];
        for (int i = 0; i < 8; i++) {
            v[i] = (glint_vec3){0.25 * (cells[c][0] + (i & 1)), 0.25 * (cells[c][1] + (i >> 1 & 1)),
                                i & 4 ? 0.25 : 0};
        }
        for (int f = 0; f < 6; f++) {
            bool is_inner = false;
            for (int next = c - 1; next <= c + 1; next += 2) {
                const int step = (f & 1) * 2 - 1;
                is_inner = is_inner || (next >= 0 && next < 8 && f < 4 &&
                                        cells[next][f / 2] == cells[c][f / 2] + step &&
                                        cells[next][1 - f / 2] == cells[c][1 - f / 2]);
            }
            if (!is_inner) {
                add_quad(&builder, v, faces[f]);
            }
        }
    }
    glint_topology topology = find(&builder);
    assert_int_equal(topology.component_count, 1);
    assert_true(topology.components[0].closed);
    assert_false(topology.components[0].simple);
    assert_false(topology.components[0].convex);
    assert_true(fabs(topology.components[0].volume - 8.0 / 64) < 1e-9);
    free_all(&builder, &topology);
}

// Very many triangles at one edge, as a hostile file may have.
static void a_fan_at_one_edge_takes_little_time(void **state)
{
    (void)state;
    enum { BLADES = 200000 };
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    const glint_vec3 low = {0, -1, 0}, high = {0, 1, 0};
    for (int i = 0; i < BLADES; i++) {
        const double angle = 2 * GLINT_PI * ((double)i * 0.618 - floor((double)i * 0.618));
        const glint_vec3 tip = {cos(angle), 0, sin(angle)};
        add(&builder, i % 2 ? low : high, i % 2 ? high : low, tip);
    }
    const clock_t begin = clock();
    glint_topology topology = find(&builder);
    assert_true((double)(clock() - begin) / CLOCKS_PER_SEC < 20);
    assert_int_equal(topology.component_count, 1); // open, with common vertices
    assert_false(topology.components[0].closed);
    free_all(&builder, &topology);
}

static void minus_zero_welds_with_zero(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0.5, 0.5, 0.5}, 0.5, 0);
    for (size_t i = 0; i < 9 * builder.scene.triangle_count; i += 2) {
        float *p = &builder.scene.positions[i];
        *p = *p == 0 ? -0.0f : *p;
    }
    glint_topology topology = find(&builder);
    assert_int_equal(topology.component_count, 1);
    assert_true(topology.components[0].convex);
    free_all(&builder, &topology);
}

static void an_empty_scene_has_no_components(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    glint_topology topology = find(&builder);
    assert_int_equal(topology.component_count, 0);
    assert_false(glint_topology_solids_may_nest(&builder.scene, &topology));
    free_all(&builder, &topology);
}

static bool may_nest(mesh_builder *builder)
{
    glint_material materials[2] = {
        {.transmission = 1, .thickness = 1, .mirror = -1},
        {.metallic = 1, .mirror = -1},
    };
    builder->scene.materials = materials;
    glint_topology topology = find(builder);
    bool result = glint_topology_solids_may_nest(&builder->scene, &topology);
    builder->scene.materials = NULL;
    free_all(builder, &topology);
    return result;
}

static void convex_solids_apart_do_not_nest(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    for (int i = 0; i < 100; i++) {
        begin_instance(&builder, 0);
        int row = i / 10;
        add_box(&builder, (glint_vec3){0.1 * (i % 10), 0.1 * row, 0}, 0.03, 0);
    }
    assert_false(may_nest(&builder));
}

static void solids_that_overlap_touch_or_bend_inwards_may_nest(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0, 0, 0}, 0.5, 0);
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0, 0, 0}, 0.25, 0);
    assert_true(may_nest(&builder));
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){-0.5, 0, 0}, 0.5, 0);
    add_box(&builder, (glint_vec3){0.25, 0, 0}, 0.25, 0);
    assert_true(may_nest(&builder));
    begin_instance(&builder, 0);
    add_revolved(&builder, bowl, 20, 20);
    assert_true(may_nest(&builder));
}

static void what_is_no_solid_does_not_count(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_box(&builder, (glint_vec3){0, 0, 0}, 0.25, 0);
    begin_instance(&builder, 1);
    add_revolved(&builder, bowl, 20, 20);
    assert_false(may_nest(&builder));
}

// A million triangles must take seconds, not minutes, on any machine.
static void a_million_triangles_take_seconds(void **state)
{
    (void)state;
    mesh_builder builder = {0};
    begin_instance(&builder, 0);
    add_revolved(&builder, sphere, 500, 1000);
    clock_t begin = clock();
    glint_topology topology = find(&builder);
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC;
    assert_true(topology.components[0].closed);
    assert_true(topology.components[0].convex);
    assert_int_equal(topology.components[0].triangle_count, 998000);
    assert_true(seconds < 20);
    free_all(&builder, &topology);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_are_convex_however_they_are_turned),
        cmocka_unit_test(a_missing_triangle_leaves_three_boundary_edges),
        cmocka_unit_test(a_turned_over_triangle_is_a_boundary),
        cmocka_unit_test(a_body_inside_out_is_closed_and_not_convex),
        cmocka_unit_test(spheres_are_convex_poles_and_all),
        cmocka_unit_test(bowls_are_not_convex_however_fine),
        cmocka_unit_test(a_dent_far_above_rounding_is_seen),
        cmocka_unit_test(a_pentagrams_bipyramid_is_not_convex),
        cmocka_unit_test(a_flat_body_without_inside_is_not_convex),
        cmocka_unit_test(components_keep_apart_by_instance_and_by_position),
        cmocka_unit_test(boxes_that_touch_are_apart),
        cmocka_unit_test(a_ring_that_meets_itself_is_not_simple),
        cmocka_unit_test(a_fan_at_one_edge_takes_little_time),
        cmocka_unit_test(minus_zero_welds_with_zero),
        cmocka_unit_test(an_empty_scene_has_no_components),
        cmocka_unit_test(convex_solids_apart_do_not_nest),
        cmocka_unit_test(solids_that_overlap_touch_or_bend_inwards_may_nest),
        cmocka_unit_test(what_is_no_solid_does_not_count),
        cmocka_unit_test(a_million_triangles_take_seconds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
