// Tests the wide tree: every triangle must be in one cluster, inside every box above it.
#include "accel/bvh.h"
#include "accel/bvh_build.h"
#include "kernels/layout.h"
#include "support/tree_checks.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void check_tree(const test_soup *s)
{
    for (int width = 8; width <= 16; width += 8) {
        glint_bvh bvh = test_tree_build(s, width);
        test_tree_check(s, &bvh);
        glint_bvh_free(&bvh);
    }
}

static void every_triangle_is_in_one_cluster_inside_every_box_above_it(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 15, 16, 17, 100, 5000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        test_soup s = test_soup_random(counts[i], 0);
        check_tree(&s);
        test_soup_free(&s);
    }
}

static void smooth_meshes_share_vertices_and_fill_the_clusters(void **state)
{
    (void)state;
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        test_soup s = test_soup_sheet(90);
        if (shuffled) {
            test_soup_shuffle(&s);
        }
        glint_bvh bvh = test_tree_build(&s, 16);
        test_tree_check(&s, &bvh);
        print_message("fill %.3f, %.1f bytes a triangle, cost %.2f\n", bvh.report.fill,
                      bvh.report.bytes_per_triangle, bvh.report.sah_cost);
        assert_true(bvh.report.fill > 0.85);
        assert_true(bvh.report.bytes_per_triangle < 42);
        glint_bvh_free(&bvh);
        test_soup_free(&s);
    }
}

// The boxes are a few roundings wider than the boxes in the computed cost.
static void the_cost_is_that_of_the_boxes(void **state)
{
    (void)state;
    test_soup s = test_soup_sheet(60);
    glint_bvh bvh = test_tree_build(&s, 16);
    test_walk w = test_tree_check(&s, &bvh);
    const float low[3] = {0, -0.1f, 0}, high[3] = {1, 0.1f, 1};
    double cost = 1 + w.area / test_half_area(low, high);
    assert_true(fabs(cost / bvh.report.sah_cost - 1) < 0.01);
    glint_bvh_free(&bvh);
    test_soup_free(&s);
}

static void a_cluster_has_one_material(void **state)
{
    (void)state;
    test_soup s = test_soup_sheet(20);
    for (size_t i = 0; i < s.count; i++) {
        s.material_of[i] = (uint32_t)(test_random() * 3);
    }
    check_tree(&s);
    test_soup_free(&s);
}

static void vertices_of_different_normals_or_signs_of_zero_are_not_shared(void **state)
{
    (void)state;
    test_soup s = test_soup_sheet(20);
    for (size_t i = 0; i < 9 * s.count; i++) {
        s.normals[i] = i / 9 % 2 == 0 ? s.normals[i] : -s.normals[i];
        s.positions[i] = s.positions[i] == 0 && i / 9 % 3 == 0 ? -0.0f : s.positions[i];
    }
    check_tree(&s);
    test_soup_free(&s);
}

static void without_normals_there_is_no_array_of_them(void **state)
{
    (void)state;
    test_soup s = test_soup_sheet(20);
    glint_bvh_inputs in = test_tree_inputs(&s, 16);
    in.normals = NULL;
    glint_bvh bvh;
    assert_int_equal(glint_bvh_build(&in, &bvh, NULL), GLINT_OK);
    assert_null(bvh.normals);
    glint_bvh_free(&bvh);
    test_soup_free(&s);
}

static void triangles_of_every_magnitude_keep_the_tree_shallow(void **state)
{
    (void)state;
    test_soup s = test_soup_random(20000, 100);
    check_tree(&s);
    glint_bvh bvh = test_tree_build(&s, 16);
    assert_true(bvh.report.depth < 64);
    glint_bvh_free(&bvh);
    test_soup_free(&s);
}

// The triangles are identical, and 16 of them share three vertices: the clusters are full.
static void coincident_triangles_are_divided_by_number(void **state)
{
    (void)state;
    test_soup s = test_soup_random(1 << 14, 0);
    for (size_t i = 1; i < s.count; i++) {
        memcpy(s.positions + 9 * i, s.positions, 9 * sizeof(float));
    }
    check_tree(&s);
    glint_bvh bvh = test_tree_build(&s, 16);
    assert_true(bvh.report.fill > 0.9);
    assert_true(bvh.report.depth < 8);
    glint_bvh_free(&bvh);
    // Triangles of several materials divide by material.
    for (size_t i = 0; i < s.count; i++) {
        s.material_of[i] = (uint32_t)(i % 3);
    }
    check_tree(&s);
    test_soup_free(&s);
}

// All centres are the origin; only the sizes differ.
static void concentric_triangles_are_divided(void **state)
{
    (void)state;
    test_soup s = test_soup_empty(20000);
    for (size_t i = 0; i < s.count; i++) {
        static const float corners[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
        for (size_t v = 0; v < 9; v++) {
            s.positions[9 * i + v] = corners[v] * (float)(i + 1) / (float)s.count;
        }
    }
    check_tree(&s);
    test_soup_free(&s);
}

static void triangles_without_area_are_left_out_and_needles_are_not(void **state)
{
    (void)state;
    enum { COUNT = 9000 };
    static bool flat[COUNT];
    test_soup s = test_soup_random(COUNT, 0);
    for (size_t i = 0; i < COUNT; i++) {
        float *p = s.positions + 9 * i;
        for (int k = 0; k < 3; k++) {
            // A needle; an edge there and back; a point; three points on an edge; a point an ulp
            // beside it.
            const float a = p[k], b = ldexpf(floorf(ldexpf(p[3 + k], 20)), -20);
            switch (i % 5) {
            case 0:
                p[3 + k] = -a;
                break;
            case 1:
                p[3 + k] = p[6 + k];
                break;
            case 2:
                p[3 + k] = p[6 + k] = a;
                break;
            default:
                p[k] = 0;
                p[3 + k] = b;
                p[6 + k] = b / 2;
                break;
            }
        }
        p[6] = i % 5 == 4 ? nextafterf(p[6], 2) : p[6];
        flat[i] = i % 5 >= 1 && i % 5 <= 3;
        s.flat_count += flat[i];
    }
    s.flat = flat;
    check_tree(&s);
    test_soup_free(&s);
}

static void triangles_that_all_have_no_area_give_a_root_that_no_ray_meets(void **state)
{
    (void)state;
    static bool flat[40];
    test_soup s = test_soup_random(40, 0);
    memset(s.positions, 0, s.count * 9 * sizeof(float));
    memset(flat, true, sizeof flat);
    s.flat = flat;
    s.flat_count = s.count;
    check_tree(&s);
    test_soup_free(&s);
}

// Bins must still separate small triangles if large triangles have their centres among them.
static void a_detail_inside_large_triangles_is_divided(void **state)
{
    (void)state;
    test_soup s = test_soup_random(20000, 0);
    for (size_t i = 0; i < 9 * s.count; i++) {
        s.positions[i] *= i / 9 % 100 == 0 ? 1 : 1e-6f;
    }
    check_tree(&s);
    glint_bvh bvh = test_tree_build(&s, 16);
    assert_true(bvh.report.depth < 16);
    glint_bvh_free(&bvh);
    test_soup_free(&s);
}

static void the_largest_finite_coordinates_do_no_harm(void **state)
{
    (void)state;
    test_soup s = test_soup_random(500, 0);
    for (size_t i = 0; i < 9 * s.count; i++) {
        s.positions[i] *= 1e29f;
    }
    check_tree(&s);
    test_soup_free(&s);
}

static glint_bvh build_on(const test_soup *s, size_t threads)
{
    glint_bvh bvh;
    glint_bvh_inputs in = test_tree_inputs(s, 16);
    in.threads = threads;
    assert_int_equal(glint_bvh_build(&in, &bvh, NULL), GLINT_OK);
    return bvh;
}

static void assert_same_tree(const glint_bvh *a, const glint_bvh *b)
{
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->cluster_count, b->cluster_count);
    assert_memory_equal(a->nodes, b->nodes,
                        a->node_count * GLINT_NODE_VALUES * (size_t)a->width * sizeof(float));
    assert_memory_equal(a->clusters, b->clusters, a->cluster_count * sizeof *a->clusters);
    assert_memory_equal(a->normals, b->normals,
                        a->cluster_count * GLINT_CLUSTER_NORMALS * sizeof *a->normals);
    assert_memory_equal(a->numbers, b->numbers,
                        a->cluster_count * GLINT_CLUSTER_LANES * sizeof *a->numbers);
    assert_true(a->report.sah_cost == b->report.sah_cost);
}

// A soup's vertices, each once, the last corner's first.
typedef struct vertices {
    uint32_t *indices;
    float *positions, *normals;
} vertices;

static bool is_same_place(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static vertices vertices_of(const test_soup *s)
{
    const size_t corners = 3 * s->count;
    const vertices all = {calloc(corners + 1, sizeof *all.indices),
                          calloc(corners + 1, 3 * sizeof(float)),
                          calloc(corners + 1, 3 * sizeof(float))};
    size_t count = 0;
    assert_non_null(all.indices);
    assert_non_null(all.positions);
    assert_non_null(all.normals);
    for (size_t i = corners; i-- > 0;) {
        size_t v = 0;
        while (v < count && !is_same_place(all.positions + 3 * v, s->positions + 3 * i)) {
            v++;
        }
        for (size_t k = 0; k < 3; k++) {
            all.positions[3 * v + k] = s->positions[3 * i + k];
            all.normals[3 * v + k] = s->normals[3 * i + k];
        }
        count = v == count ? count + 1 : count;
        all.indices[i] = (uint32_t)v;
    }
    assert_true(count < corners / 5);
    return all;
}

// Normals are by vertex or by corner.
static void indices_give_the_same_tree(void **state)
{
    (void)state;
    test_soup s = test_soup_sheet(40);
    for (size_t i = 0; i < 3 * s.count; i++) { // normals that differ by vertex
        s.normals[3 * i] = s.positions[3 * i];
    }
    const vertices all = vertices_of(&s);
    glint_bvh expected = test_tree_build(&s, 16), shared, mixed;
    glint_bvh_inputs in = test_tree_inputs(&s, 16);
    in.indices = all.indices;
    in.positions = all.positions;
    in.normals = all.normals;
    assert_int_equal(glint_bvh_build(&in, &shared, NULL), GLINT_OK);
    assert_same_tree(&shared, &expected);
    assert_true(glint_bvh_refit(&in, &shared)); // to the same places
    assert_memory_equal(shared.clusters, expected.clusters,
                        expected.cluster_count * sizeof *expected.clusters);
    assert_memory_equal(shared.normals, expected.normals,
                        expected.cluster_count * GLINT_CLUSTER_NORMALS * sizeof(float));
    in.normals = s.normals;
    in.has_normals_by_corner = true;
    assert_int_equal(glint_bvh_build(&in, &mixed, NULL), GLINT_OK);
    assert_same_tree(&mixed, &expected);
    glint_bvh_free(&expected);
    glint_bvh_free(&shared);
    glint_bvh_free(&mixed);
    free(all.indices);
    free(all.positions);
    free(all.normals);
    test_soup_free(&s);
}

static void any_number_of_threads_gives_the_same_tree(void **state)
{
    (void)state;
    // Triangles in order, shuffled, of every magnitude, and identical triangles.
    test_soup soups[] = {test_soup_sheet(200), test_soup_sheet(200), test_soup_random(50000, 60),
                         test_soup_sheet(150)};
    test_soup_shuffle(&soups[1]);
    for (size_t i = 1; i < soups[3].count; i++) {
        memcpy(soups[3].positions + 9 * i, soups[3].positions, 9 * sizeof(float));
    }
    for (size_t i = 0; i < sizeof soups / sizeof *soups; i++) {
        glint_bvh alone = build_on(&soups[i], 1);
        static const size_t threads[] = {0, 2, 3, 8, 64};
        for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
            glint_bvh together = build_on(&soups[i], threads[k]);
            assert_same_tree(&alone, &together);
            glint_bvh_free(&together);
        }
        glint_bvh_free(&alone);
        test_soup_free(&soups[i]);
    }
}

static void no_triangles_give_an_empty_tree(void **state)
{
    (void)state;
    glint_bvh bvh;
    glint_bvh_inputs in = {.width = 16};
    assert_int_equal(glint_bvh_build(&in, &bvh, NULL), GLINT_OK);
    assert_int_equal(bvh.node_count, 0);
    assert_int_equal(bvh.cluster_count, 0);
    glint_bvh_free(&bvh);
}

static void more_triangles_than_a_place_can_name_are_refused(void **state)
{
    (void)state;
    glint_bvh bvh;
    glint_error error = {0};
    // The builder must refuse this before it reads anything.
    glint_bvh_inputs in = {.triangle_count = (size_t)GLINT_TRIANGLES_MAX + 1, .width = 16};
    assert_int_equal(glint_bvh_build(&in, &bvh, &error), GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "134217728 triangles"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_triangle_is_in_one_cluster_inside_every_box_above_it),
        cmocka_unit_test(smooth_meshes_share_vertices_and_fill_the_clusters),
        cmocka_unit_test(the_cost_is_that_of_the_boxes),
        cmocka_unit_test(a_cluster_has_one_material),
        cmocka_unit_test(vertices_of_different_normals_or_signs_of_zero_are_not_shared),
        cmocka_unit_test(without_normals_there_is_no_array_of_them),
        cmocka_unit_test(triangles_of_every_magnitude_keep_the_tree_shallow),
        cmocka_unit_test(coincident_triangles_are_divided_by_number),
        cmocka_unit_test(concentric_triangles_are_divided),
        cmocka_unit_test(triangles_without_area_are_left_out_and_needles_are_not),
        cmocka_unit_test(triangles_that_all_have_no_area_give_a_root_that_no_ray_meets),
        cmocka_unit_test(a_detail_inside_large_triangles_is_divided),
        cmocka_unit_test(the_largest_finite_coordinates_do_no_harm),
        cmocka_unit_test(indices_give_the_same_tree),
        cmocka_unit_test(any_number_of_threads_gives_the_same_tree),
        cmocka_unit_test(no_triangles_give_an_empty_tree),
        cmocka_unit_test(more_triangles_than_a_place_can_name_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
