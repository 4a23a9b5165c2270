// Properties of the wide tree: every triangle is in one leaf, inside every box above it.
#include "accel/bvh.h"
#include "kernels/layout.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// SplitMix64: the tests are the same on every machine.
static uint64_t random_state;

static double random_number(void)
{
    random_state += 0x9e3779b97f4a7c15u;
    uint64_t z = random_state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

typedef struct soup {
    float *positions;
    size_t count;
} soup;

// Small triangles whose size and place span many orders of magnitude when `spread` is large.
static soup random_soup(size_t count, double spread)
{
    random_state = count;
    soup s = {malloc(count * 9 * sizeof(float)), count};
    assert_non_null(s.positions);
    for (size_t i = 0; i < count; i++) {
        double scale = exp2(-spread * random_number());
        for (int v = 0; v < 9; v++) {
            double center = v < 3 ? 0 : (double)s.positions[9 * i + (size_t)v % 3];
            double wide = v < 3 ? scale : scale * 0.1;
            s.positions[9 * i + (size_t)v] = (float)(center + wide * (2 * random_number() - 1));
        }
    }
    return s;
}

static int32_t child_of(const glint_bvh *bvh, size_t node, int child)
{
    int32_t value;
    const float *base = bvh->nodes + node * GLINT_NODE_VALUES * (size_t)bvh->width;
    memcpy(&value, base + 6 * bvh->width + child, sizeof value);
    return value;
}

typedef struct walk {
    const soup *soup;
    const glint_bvh *bvh;
    unsigned char *seen;
    size_t nodes;
    int stack_need;
} walk;

static void check_inside(const walk *w, size_t place, const float low[3], const float high[3])
{
    const float *p = w->soup->positions + 9 * (size_t)w->bvh->order[place];
    for (int v = 0; v < 9; v++) {
        assert_true(p[v] >= low[v % 3] && p[v] <= high[v % 3]);
    }
}

// `low` and `high` are the box of the node; `waiting` what a traversal may have on its stack.
static void visit(walk *w, size_t node, const float low[3], const float high[3], int waiting)
{
    int width = w->bvh->width, used = 0;
    const float *base = w->bvh->nodes + node * GLINT_NODE_VALUES * (size_t)width;
    w->nodes++;
    while (used < width && base[used] < GLINT_FAR) {
        used++;
    }
    if (waiting + used > w->stack_need) {
        w->stack_need = waiting + used;
    }
    for (int c = 0; c < used; c++) {
        float child_low[3], child_high[3];
        for (int k = 0; k < 3; k++) {
            child_low[k] = base[k * width + c];
            child_high[k] = base[(3 + k) * width + c];
            assert_true(child_low[k] <= child_high[k]);
        }
        int32_t child = child_of(w->bvh, node, c);
        if (child >= 0) {
            visit(w, (size_t)child, child_low, child_high, waiting + used - 1);
            continue;
        }
        size_t first = (size_t)~child / GLINT_LEAF_MAX, count = (size_t)~child % GLINT_LEAF_MAX + 1;
        for (size_t place = first; place < first + count; place++) {
            assert_true(place < w->soup->count);
            assert_int_equal(w->seen[place]++, 0);
            check_inside(w, place, child_low, child_high);
            check_inside(w, place, low, high);
        }
    }
}

static void check_tree(const soup *s, int width)
{
    glint_bvh bvh;
    glint_error error = {0};
    assert_int_equal(glint_bvh_build(s->positions, s->count, width, &bvh, &error), GLINT_OK);
    walk w = {s, &bvh, calloc(s->count, 1), 0, 0};
    unsigned char *ordered = calloc(s->count, 1);
    assert_non_null(w.seen);
    assert_non_null(ordered);
    const float low[3] = {-INFINITY, -INFINITY, -INFINITY};
    const float high[3] = {INFINITY, INFINITY, INFINITY};
    visit(&w, 0, low, high, 0);
    for (size_t i = 0; i < s->count; i++) {
        assert_int_equal(w.seen[i], 1);
        assert_int_equal(ordered[bvh.order[i]]++, 0);
    }
    assert_int_equal(w.nodes, bvh.node_count);
    assert_true(bvh.report.stack_need >= w.stack_need);
    assert_true(bvh.report.mean_leaf_size <= GLINT_LEAF_MAX);
    free(w.seen);
    free(ordered);
    glint_bvh_free(&bvh);
}

static void every_triangle_is_in_one_leaf_inside_every_box_above_it(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 15, 16, 17, 100, 5000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        soup s = random_soup(counts[i], 0);
        check_tree(&s, 8);
        check_tree(&s, 16);
        free(s.positions);
    }
}

static void triangles_of_every_magnitude_keep_the_tree_shallow(void **state)
{
    (void)state;
    soup s = random_soup(20000, 100);
    check_tree(&s, 16);
    glint_bvh bvh;
    assert_int_equal(glint_bvh_build(s.positions, s.count, 16, &bvh, NULL), GLINT_OK);
    assert_true(bvh.report.depth < 40);
    glint_bvh_free(&bvh);
    free(s.positions);
}

static void coincident_triangles_are_divided_by_number(void **state)
{
    (void)state;
    soup s = random_soup(1000, 0);
    for (size_t i = 1; i < s.count; i++) {
        memcpy(s.positions + 9 * i, s.positions, 9 * sizeof(float));
    }
    check_tree(&s, 16);
    check_tree(&s, 8);
    free(s.positions);
}

static void the_largest_finite_coordinates_do_no_harm(void **state)
{
    (void)state;
    soup s = random_soup(500, 0);
    for (size_t i = 0; i < 9 * s.count; i++) {
        s.positions[i] *= 1e29f;
    }
    check_tree(&s, 16);
    free(s.positions);
}

static void the_same_triangles_give_the_same_tree(void **state)
{
    (void)state;
    soup s = random_soup(3000, 3);
    glint_bvh a, b;
    assert_int_equal(glint_bvh_build(s.positions, s.count, 16, &a, NULL), GLINT_OK);
    assert_int_equal(glint_bvh_build(s.positions, s.count, 16, &b, NULL), GLINT_OK);
    assert_int_equal(a.node_count, b.node_count);
    assert_memory_equal(a.nodes, b.nodes, a.node_count * GLINT_NODE_VALUES * 16 * sizeof(float));
    assert_memory_equal(a.order, b.order, s.count * sizeof *a.order);
    glint_bvh_free(&a);
    glint_bvh_free(&b);
    free(s.positions);
}

static void no_triangles_give_an_empty_tree(void **state)
{
    (void)state;
    glint_bvh bvh;
    assert_int_equal(glint_bvh_build(NULL, 0, 16, &bvh, NULL), GLINT_OK);
    assert_int_equal(bvh.node_count, 0);
    glint_bvh_free(&bvh);
}

static void more_triangles_than_a_leaf_can_name_are_refused(void **state)
{
    (void)state;
    glint_bvh bvh;
    glint_error error = {0};
    // Refused before anything is read.
    assert_int_equal(glint_bvh_build(NULL, (size_t)GLINT_TRIANGLES_MAX + 1, 16, &bvh, &error),
                     GLINT_BAD_INPUT);
    assert_non_null(strstr(error.message, "134217728 triangles"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_triangle_is_in_one_leaf_inside_every_box_above_it),
        cmocka_unit_test(triangles_of_every_magnitude_keep_the_tree_shallow),
        cmocka_unit_test(coincident_triangles_are_divided_by_number),
        cmocka_unit_test(the_largest_finite_coordinates_do_no_harm),
        cmocka_unit_test(the_same_triangles_give_the_same_tree),
        cmocka_unit_test(no_triangles_give_an_empty_tree),
        cmocka_unit_test(more_triangles_than_a_leaf_can_name_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
