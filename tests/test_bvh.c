// Properties of the wide tree: every triangle is in one cluster, inside every box above it.
#include "accel/bvh.h"
#include "kernels/layout.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
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
    float *positions, *normals; // [count][3][3]
    uint32_t *material_of;
    size_t count;
    const bool *flat; // which of them have no area; NULL: none
    size_t flat_count;
} soup;

// Without positions yet; one material, and one normal for all vertices.
static soup empty_soup(size_t count)
{
    soup s = {.positions = malloc(count * 9 * sizeof(float)),
              .normals = calloc(count * 9, sizeof(float)),
              .material_of = calloc(count, sizeof(uint32_t)),
              .count = count};
    assert_non_null(s.positions);
    assert_non_null(s.normals);
    assert_non_null(s.material_of);
    for (size_t vertex = 0; vertex < 3 * count; vertex++) {
        s.normals[3 * vertex + 1] = 1;
    }
    return s;
}

static void free_soup(soup *s)
{
    free(s->positions);
    free(s->normals);
    free(s->material_of);
}

// Small triangles whose size and place span many orders of magnitude when `spread` is large.
static soup random_soup(size_t count, double spread)
{
    random_state = count;
    soup s = empty_soup(count);
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

// A wavy sheet of 2 × edge² triangles that share their vertices.
static soup sheet(size_t edge)
{
    static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    soup s = empty_soup(2 * edge * edge);
    for (size_t i = 0; i < 6 * edge * edge; i++) {
        size_t column = i / 6 % edge, row = i / 6 / edge;
        double x = ((double)column + corners[i % 6][0]) / (double)edge;
        double z = ((double)row + corners[i % 6][1]) / (double)edge;
        s.positions[3 * i] = (float)x;
        s.positions[3 * i + 1] = (float)(0.1 * sin(9 * x) * cos(7 * z));
        s.positions[3 * i + 2] = (float)z;
    }
    return s;
}

// Puts the triangles in an order that has nothing to do with where they are.
static void shuffle(soup *s)
{
    for (size_t i = s->count - 1; i > 0; i--) {
        size_t k = (size_t)(random_number() * (double)(i + 1));
        float swap[9];
        memcpy(swap, s->positions + 9 * i, sizeof swap);
        memcpy(s->positions + 9 * i, s->positions + 9 * k, sizeof swap);
        memcpy(s->positions + 9 * k, swap, sizeof swap);
    }
}

static glint_bvh_inputs inputs_of(const soup *s, int width)
{
    return (glint_bvh_inputs){
        .positions = s->positions,
        .normals = s->normals,
        .material_of = s->material_of,
        .triangle_count = s->count,
        .width = width,
    };
}

static glint_bvh build(const soup *s, int width)
{
    glint_bvh bvh;
    glint_bvh_inputs in = inputs_of(s, width);
    glint_error error = {0};
    assert_int_equal(glint_bvh_build(&in, &bvh, &error), GLINT_OK);
    return bvh;
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
    unsigned char *seen; // by triangle
    size_t nodes, clusters;
    int depth, stack_need;
    double area; // of the boxes of nodes and clusters
} walk;

static void check_box(const float *p, const float low[3], const float high[3])
{
    for (int v = 0; v < 9; v++) {
        assert_true(p[v] >= low[v % 3] && p[v] <= high[v % 3]);
    }
}

// The values of one corner, [3][GLINT_CLUSTER_LANES] of them, are the vertex's bit for bit.
static void check_corner(const float *values, const glint_cluster *cluster, int corner, int lane,
                         const float vertex[3])
{
    int vertex_lane = cluster->corners[corner][lane];
    assert_in_range(vertex_lane, 0, GLINT_CLUSTER_LANES - 1);
    for (int k = 0; k < 3; k++) {
        assert_memory_equal(values + k * GLINT_CLUSTER_LANES + vertex_lane, vertex + k,
                            sizeof(float));
    }
}

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

// No two vertices are the same, and what is past the last repeats the first.
static void check_vertices(const glint_cluster *cluster, const float *normals)
{
    int last = 0;
    for (int i = 0; i < 3 * GLINT_CLUSTER_LANES; i++) {
        int lane = (&cluster->corners[0][0])[i];
        last = lane > last ? lane : last;
    }
    for (int a = 0; a < GLINT_CLUSTER_LANES; a++) {
        for (int b = 0; b < a; b++) {
            bool same = true;
            for (int k = 0; k < 3; k++) {
                const float *p = cluster->positions[k], *n = normals + k * GLINT_CLUSTER_LANES;
                same = same && bits_of(p[a]) == bits_of(p[b]) && bits_of(n[a]) == bits_of(n[b]);
            }
            assert_int_equal(same, a > last && (b == 0 || b > last));
        }
    }
}

static void check_cluster(walk *w, size_t index, const float low[3], const float high[3])
{
    const glint_cluster *cluster = &w->bvh->clusters[index];
    const float *normals = w->bvh->normals + index * GLINT_CLUSTER_NORMALS;
    const int32_t *numbers = w->bvh->numbers + index * GLINT_CLUSTER_LANES;
    assert_in_range(cluster->count, 1, GLINT_CLUSTER_LANES);
    assert_true(cluster->unused[0] == 0 && cluster->unused[1] == 0);
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        if (lane >= cluster->count) {
            assert_int_equal(numbers[lane], -1);
            assert_int_equal(cluster->corners[0][lane] | cluster->corners[1][lane] |
                                 cluster->corners[2][lane],
                             0);
            continue;
        }
        assert_in_range(numbers[lane], 0, w->soup->count - 1);
        size_t triangle = (size_t)numbers[lane];
        assert_int_equal(w->seen[triangle]++, 0);
        assert_int_equal(w->soup->material_of[triangle], cluster->material);
        for (int corner = 0; corner < 3; corner++) {
            size_t value = 9 * triangle + 3 * (size_t)corner;
            check_corner(cluster->positions[0], cluster, corner, lane, w->soup->positions + value);
            check_corner(normals, cluster, corner, lane, w->soup->normals + value);
        }
        check_box(w->soup->positions + 9 * triangle, low, high);
    }
    check_vertices(cluster, normals);
}

static double half_area(const float low[3], const float high[3])
{
    double x = (double)high[0] - (double)low[0], y = (double)high[1] - (double)low[1];
    double z = (double)high[2] - (double)low[2];
    return x * y + y * z + z * x;
}

// `low` and `high` are the box of the node; `waiting` what a traversal may have on its stack.
static void visit(walk *w, size_t node, const float low[3], const float high[3], int depth,
                  int waiting)
{
    int width = w->bvh->width, used = 0;
    const float *base = w->bvh->nodes + node * GLINT_NODE_VALUES * (size_t)width;
    w->nodes++;
    w->depth = depth + 1 > w->depth ? depth + 1 : w->depth;
    while (used < width && base[used] < GLINT_FAR) {
        used++;
    }
    assert_true(used >= 2 || node == 0);
    w->stack_need = waiting + used > w->stack_need ? waiting + used : w->stack_need;
    for (int c = 0; c < width; c++) {
        float child_low[3], child_high[3];
        int32_t child = child_of(w->bvh, node, c);
        for (int k = 0; k < 3; k++) {
            child_low[k] = base[k * width + c];
            child_high[k] = base[(3 + k) * width + c];
        }
        if (c >= used) {
            assert_true(child == 0 && child_low[1] == GLINT_FAR && child_low[2] == GLINT_FAR);
            assert_true(child_high[0] == GLINT_FAR && child_high[1] == GLINT_FAR &&
                        child_high[2] == GLINT_FAR);
            continue;
        }
        for (int k = 0; k < 3; k++) {
            assert_true(child_low[k] <= child_high[k]);
            assert_true(child_low[k] >= low[k] && child_high[k] <= high[k]);
        }
        w->area += half_area(child_low, child_high);
        if (child >= 0) {
            assert_in_range(child, 1, w->bvh->node_count - 1);
            visit(w, (size_t)child, child_low, child_high, depth + 1, waiting + used - 1);
            continue;
        }
        int32_t cluster = ~child;
        assert_in_range(cluster, 0, w->bvh->cluster_count - 1);
        w->clusters++;
        check_cluster(w, (size_t)cluster, child_low, child_high);
    }
}

static void check_report(const walk *w, const glint_bvh *bvh)
{
    const glint_bvh_report *report = &bvh->report;
    size_t cluster_bytes =
        (GLINT_CLUSTER_VALUES + GLINT_CLUSTER_NORMALS + GLINT_CLUSTER_LANES) * sizeof(float);
    assert_int_equal(report->node_count, bvh->node_count);
    assert_int_equal(report->cluster_count, bvh->cluster_count);
    assert_int_equal(report->depth, w->depth);
    assert_int_equal(report->stack_need, w->stack_need);
    assert_int_equal(report->bytes,
                     bvh->node_count * GLINT_NODE_VALUES * (size_t)bvh->width * sizeof(float) +
                         bvh->cluster_count * cluster_bytes);
    double lanes = (double)bvh->cluster_count * GLINT_CLUSTER_LANES;
    const size_t kept = w->soup->count - w->soup->flat_count;
    assert_int_equal(report->triangle_count, kept);
    assert_true(fabs(report->fill - (lanes > 0 ? (double)kept / lanes : 0)) < 1e-12);
}

static walk check_bvh(const soup *s, const glint_bvh *bvh)
{
    walk w = {.soup = s, .bvh = bvh, .seen = calloc(s->count, 1)};
    assert_non_null(w.seen);
    const float low[3] = {-INFINITY, -INFINITY, -INFINITY};
    const float high[3] = {INFINITY, INFINITY, INFINITY};
    visit(&w, 0, low, high, 0, 0);
    for (size_t i = 0; i < s->count; i++) {
        assert_int_equal(w.seen[i], s->flat == NULL || !s->flat[i]);
    }
    assert_int_equal(w.nodes, bvh->node_count);
    assert_int_equal(w.clusters, bvh->cluster_count);
    check_report(&w, bvh);
    free(w.seen);
    return w;
}

static void check_tree(const soup *s)
{
    for (int width = 8; width <= 16; width += 8) {
        glint_bvh bvh = build(s, width);
        check_bvh(s, &bvh);
        glint_bvh_free(&bvh);
    }
}

static void every_triangle_is_in_one_cluster_inside_every_box_above_it(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 15, 16, 17, 100, 5000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        soup s = random_soup(counts[i], 0);
        check_tree(&s);
        free_soup(&s);
    }
}

static void smooth_meshes_share_vertices_and_fill_the_clusters(void **state)
{
    (void)state;
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        soup s = sheet(90);
        if (shuffled) {
            shuffle(&s);
        }
        glint_bvh bvh = build(&s, 16);
        check_bvh(&s, &bvh);
        print_message("fill %.3f, %.1f bytes a triangle, cost %.2f\n", bvh.report.fill,
                      bvh.report.bytes_per_triangle, bvh.report.sah_cost);
        assert_true(bvh.report.fill > 0.85);
        assert_true(bvh.report.bytes_per_triangle < 42);
        glint_bvh_free(&bvh);
        free_soup(&s);
    }
}

// The boxes are wider than what the cost is computed from by a few roundings.
static void the_cost_is_that_of_the_boxes(void **state)
{
    (void)state;
    soup s = sheet(60);
    glint_bvh bvh = build(&s, 16);
    walk w = check_bvh(&s, &bvh);
    const float low[3] = {0, -0.1f, 0}, high[3] = {1, 0.1f, 1};
    double cost = 1 + w.area / half_area(low, high);
    assert_true(fabs(cost / bvh.report.sah_cost - 1) < 0.01);
    glint_bvh_free(&bvh);
    free_soup(&s);
}

static void a_cluster_has_one_material(void **state)
{
    (void)state;
    soup s = sheet(20);
    for (size_t i = 0; i < s.count; i++) {
        s.material_of[i] = (uint32_t)(random_number() * 3);
    }
    check_tree(&s);
    free_soup(&s);
}

static void vertices_of_different_normals_or_signs_of_zero_are_not_shared(void **state)
{
    (void)state;
    soup s = sheet(20);
    for (size_t i = 0; i < 9 * s.count; i++) {
        s.normals[i] = i / 9 % 2 == 0 ? s.normals[i] : -s.normals[i];
        s.positions[i] = s.positions[i] == 0 && i / 9 % 3 == 0 ? -0.0f : s.positions[i];
    }
    check_tree(&s);
    free_soup(&s);
}

static void without_normals_there_is_no_array_of_them(void **state)
{
    (void)state;
    soup s = sheet(20);
    glint_bvh_inputs in = inputs_of(&s, 16);
    in.normals = NULL;
    glint_bvh bvh;
    assert_int_equal(glint_bvh_build(&in, &bvh, NULL), GLINT_OK);
    assert_null(bvh.normals);
    glint_bvh_free(&bvh);
    free_soup(&s);
}

static void triangles_of_every_magnitude_keep_the_tree_shallow(void **state)
{
    (void)state;
    soup s = random_soup(20000, 100);
    check_tree(&s);
    glint_bvh bvh = build(&s, 16);
    assert_true(bvh.report.depth < 64);
    glint_bvh_free(&bvh);
    free_soup(&s);
}

// Nothing tells them apart, and 16 of them share their three vertices: the clusters are full.
static void coincident_triangles_are_divided_by_number(void **state)
{
    (void)state;
    soup s = random_soup(1 << 14, 0);
    for (size_t i = 1; i < s.count; i++) {
        memcpy(s.positions + 9 * i, s.positions, 9 * sizeof(float));
    }
    check_tree(&s);
    glint_bvh bvh = build(&s, 16);
    assert_true(bvh.report.fill > 0.9);
    assert_true(bvh.report.depth < 8);
    glint_bvh_free(&bvh);
    // Of several materials, they are told apart by those.
    for (size_t i = 0; i < s.count; i++) {
        s.material_of[i] = (uint32_t)(i % 3);
    }
    check_tree(&s);
    free_soup(&s);
}

// All centres are the origin; only the sizes differ.
static void concentric_triangles_are_divided(void **state)
{
    (void)state;
    soup s = empty_soup(20000);
    for (size_t i = 0; i < s.count; i++) {
        static const float corners[9] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
        for (size_t v = 0; v < 9; v++) {
            s.positions[9 * i + v] = corners[v] * (float)(i + 1) / (float)s.count;
        }
    }
    check_tree(&s);
    free_soup(&s);
}

static void triangles_without_area_are_left_out_and_needles_are_not(void **state)
{
    (void)state;
    enum { COUNT = 9000 };
    static bool flat[COUNT];
    soup s = random_soup(COUNT, 0);
    for (size_t i = 0; i < COUNT; i++) {
        float *p = s.positions + 9 * i;
        for (int k = 0; k < 3; k++) {
            // A needle; an edge there and back; a point; three points of an edge; an ulp beside it.
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
    free_soup(&s);
}

static void triangles_that_all_have_no_area_give_a_root_that_no_ray_meets(void **state)
{
    (void)state;
    static bool flat[40];
    soup s = random_soup(40, 0);
    memset(s.positions, 0, s.count * 9 * sizeof(float));
    memset(flat, true, sizeof flat);
    s.flat = flat;
    s.flat_count = s.count;
    check_tree(&s);
    free_soup(&s);
}

// Large triangles whose centres lie in the middle of small ones must not hide them from the bins.
static void a_detail_inside_large_triangles_is_divided(void **state)
{
    (void)state;
    soup s = random_soup(20000, 0);
    for (size_t i = 0; i < 9 * s.count; i++) {
        s.positions[i] *= i / 9 % 100 == 0 ? 1 : 1e-6f;
    }
    check_tree(&s);
    glint_bvh bvh = build(&s, 16);
    assert_true(bvh.report.depth < 16);
    glint_bvh_free(&bvh);
    free_soup(&s);
}

static void the_largest_finite_coordinates_do_no_harm(void **state)
{
    (void)state;
    soup s = random_soup(500, 0);
    for (size_t i = 0; i < 9 * s.count; i++) {
        s.positions[i] *= 1e29f;
    }
    check_tree(&s);
    free_soup(&s);
}

static glint_bvh build_on(const soup *s, size_t threads)
{
    glint_bvh bvh;
    glint_bvh_inputs in = inputs_of(s, 16);
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

static void any_number_of_threads_gives_the_same_tree(void **state)
{
    (void)state;
    // Bundled, not bundled, of every magnitude, and all alike.
    soup soups[] = {sheet(200), sheet(200), random_soup(50000, 60), sheet(150)};
    shuffle(&soups[1]);
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
        free_soup(&soups[i]);
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
    // Refused before anything is read.
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
        cmocka_unit_test(any_number_of_threads_gives_the_same_tree),
        cmocka_unit_test(no_triangles_give_an_empty_tree),
        cmocka_unit_test(more_triangles_than_a_place_can_name_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
