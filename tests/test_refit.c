// Tests refitting a tree to moved triangles: it must stay a valid tree, with a true cost.
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

// Rotates vertices [first, last) about an axis that is not an axis of the scene, and moves them.
static void turn(test_soup *s, size_t first, size_t last, double angle, double away)
{
    const double c = cos(angle), n = sin(angle);
    for (size_t vertex = first; vertex < last; vertex++) {
        float *p = s->positions + 3 * vertex;
        const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        p[0] = (float)(0.8 * (c * x - n * y) + 0.6 * z + away);
        p[1] = (float)(n * x + c * y);
        p[2] = (float)(-0.6 * (c * x - n * y) + 0.8 * z);
    }
}

static bool refit(const test_soup *s, glint_bvh *bvh)
{
    const glint_bvh_inputs in = test_tree_inputs(s, bvh->width);
    return glint_bvh_refit(&in, bvh);
}

static void nothing_moved_is_the_tree_as_it_was_built(void **state)
{
    (void)state;
    test_soup soups[] = {test_soup_sheet(60), test_soup_random(3000, 20), test_soup_sheet(1),
                         test_soup_random(1, 0)};
    for (size_t i = 0; i < sizeof soups / sizeof *soups; i++) {
        for (int width = 8; width <= 16; width += 8) {
            glint_bvh built = test_tree_build(&soups[i], width);
            glint_bvh fitted = test_tree_build(&soups[i], width);
            assert_true(refit(&soups[i], &fitted));
            assert_memory_equal(built.nodes, fitted.nodes,
                                built.node_count * GLINT_NODE_VALUES * (size_t)width *
                                    sizeof(float));
            assert_memory_equal(built.clusters, fitted.clusters,
                                built.cluster_count * sizeof *built.clusters);
            assert_memory_equal(built.normals, fitted.normals,
                                built.cluster_count * GLINT_CLUSTER_NORMALS * sizeof(float));
            assert_memory_equal(built.numbers, fitted.numbers,
                                built.cluster_count * GLINT_CLUSTER_LANES * sizeof(int32_t));
            // Sums of at most 2e4 doubles in another order.
            assert_true(fabs(fitted.report.sah_cost / built.report.sah_cost - 1) < 2e4 * 0x1p-52);
            glint_bvh_free(&built);
            glint_bvh_free(&fitted);
        }
        test_soup_free(&soups[i]);
    }
}

// The whole soup moves, or one half away from the other, with changed normals.
static void what_moved_is_in_its_boxes(void **state)
{
    (void)state;
    for (int trial = 0; trial < 20; trial++) {
        test_soup s = trial % 2 == 0 ? test_soup_sheet(10 + (size_t)trial * 3)
                                     : test_soup_random(200 + 400 * (size_t)trial, 10);
        // Halves without shared vertices.
        const size_t half = s.count / 2 * 3, all = 3 * s.count;
        turn(&s, half, all, 0, 5);
        glint_bvh bvh = test_tree_build(&s, trial % 4 < 2 ? 8 : 16);
        for (int frame = 0; frame < 4; frame++) {
            turn(&s, half, all, 0.3 * test_random(), test_random());
            if (frame % 2 == 1) {
                turn(&s, 0, half, 3 * test_random(), 0);
                for (size_t i = 0; i < all; i++) {
                    s.normals[3 * i] = i < half ? 0.6f : -0.6f;
                    s.normals[3 * i + 1] = 0.8f;
                }
            }
            assert_true(refit(&s, &bvh));
            test_tree_check(&s, &bvh);
        }
        glint_bvh_free(&bvh);
        test_soup_free(&s);
    }
}

static void move_triangles(test_soup *s, double by, bool each_by_another)
{
    for (size_t triangle = 0; triangle < s->count; triangle++) {
        const double x = each_by_another ? by * test_random() : by;
        for (size_t vertex = 0; vertex < 3; vertex++) {
            float *p = s->positions + 9 * triangle + 3 * vertex;
            p[0] = (float)((double)p[0] + x);
        }
    }
}

// A motion of the whole soup keeps the size of every box. If neighbouring triangles scatter, the
// refitted tree costs many times as much as a new tree.
static void the_cost_tells_when_to_build_anew(void **state)
{
    (void)state;
    test_soup s = test_soup_random(4000, 0);
    glint_bvh fitted = test_tree_build(&s, 8);
    const double before = fitted.report.sah_cost;
    move_triangles(&s, 7, false);
    assert_true(refit(&s, &fitted));
    // Positions are eight times as coarse there: 4e-7, with boxes of 1e-2 and more.
    assert_true(fabs(fitted.report.sah_cost / before - 1) < 1e-3);
    move_triangles(&s, 10, true);
    assert_true(refit(&s, &fitted));
    test_tree_check(&s, &fitted);
    glint_bvh built = test_tree_build(&s, 8);
    assert_true(fitted.report.sah_cost > 2 * built.report.sah_cost);
    assert_true(fitted.report.root_area == built.report.root_area);
    glint_bvh_free(&built);
    glint_bvh_free(&fitted);
    test_soup_free(&s);
}

static void assert_does_not_serve(const test_soup *before, const test_soup *after, int width)
{
    glint_bvh bvh = test_tree_build(before, width);
    assert_false(refit(after, &bvh));
    glint_bvh_free(&bvh);
}

static test_soup copy_of(const test_soup *s)
{
    test_soup copy = test_soup_empty(s->count);
    memcpy(copy.positions, s->positions, s->count * 9 * sizeof(float));
    memcpy(copy.normals, s->normals, s->count * 9 * sizeof(float));
    return copy;
}

static void a_tree_that_does_not_serve_is_refused(void **state)
{
    (void)state;
    test_soup s = test_soup_sheet(12);

    test_soup torn = copy_of(&s);
    torn.positions[9 * 100] += 1; // other triangles share this vertex
    assert_does_not_serve(&s, &torn, 8);
    test_soup_free(&torn);

    torn = copy_of(&s);
    torn.normals[9 * 100] = 1;
    assert_does_not_serve(&s, &torn, 8);
    test_soup_free(&torn);

    test_soup flat = copy_of(&s);
    memcpy(flat.positions + 9 * 50, flat.positions + 9 * 50 + 3, 3 * sizeof(float));
    assert_does_not_serve(&s, &flat, 8);
    // A triangle without area has one now.
    assert_does_not_serve(&flat, &s, 8);
    test_soup_free(&flat);

    test_soup painted = copy_of(&s);
    painted.material_of[7] = 1;
    assert_does_not_serve(&s, &painted, 16);
    test_soup_free(&painted);

    test_soup fewer = copy_of(&s);
    fewer.count--;
    assert_does_not_serve(&s, &fewer, 8);
    test_soup_free(&fewer);

    glint_bvh bvh = test_tree_build(&s, 8);
    glint_bvh_inputs in = test_tree_inputs(&s, 16);
    assert_false(glint_bvh_refit(&in, &bvh)); // another tree width
    in = test_tree_inputs(&s, 8);
    in.normals = NULL;
    assert_false(glint_bvh_refit(&in, &bvh));
    glint_bvh_free(&bvh);
    assert_false(glint_bvh_refit(&in, &bvh)); // no tree
    test_soup_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_moved_is_the_tree_as_it_was_built),
        cmocka_unit_test(what_moved_is_in_its_boxes),
        cmocka_unit_test(the_cost_tells_when_to_build_anew),
        cmocka_unit_test(a_tree_that_does_not_serve_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
