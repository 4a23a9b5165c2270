// Checks trees. See tree_checks.h.
#include "support/tree_checks.h"

#include "accel/bvh_build.h"
#include "kernels/layout.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// State of SplitMix64: the tests are the same on every machine.
static uint64_t random_state;

double test_random(void)
{
    random_state += 0x9e3779b97f4a7c15u;
    uint64_t z = random_state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// See tree_checks.h.
test_soup test_soup_empty(size_t count)
{
    test_soup s = {.positions = malloc(count * 9 * sizeof(float)),
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

void test_soup_free(test_soup *s)
{
    free(s->positions);
    free(s->normals);
    free(s->material_of);
}

// See tree_checks.h.
test_soup test_soup_random(size_t count, double spread)
{
    random_state = count;
    test_soup s = test_soup_empty(count);
    for (size_t i = 0; i < count; i++) {
        double scale = exp2(-spread * test_random());
        for (int v = 0; v < 9; v++) {
            double center = v < 3 ? 0 : (double)s.positions[9 * i + (size_t)v % 3];
            double wide = v < 3 ? scale : scale * 0.1;
            s.positions[9 * i + (size_t)v] = (float)(center + wide * (2 * test_random() - 1));
        }
    }
    return s;
}

// See tree_checks.h.
test_soup test_soup_sheet(size_t edge)
{
    static const int corners[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    test_soup s = test_soup_empty(2 * edge * edge);
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

// See tree_checks.h.
void test_soup_shuffle(test_soup *s)
{
    for (size_t i = s->count - 1; i > 0; i--) {
        size_t k = (size_t)(test_random() * (double)(i + 1));
        float swap[9];
        memcpy(swap, s->positions + 9 * i, sizeof swap);
        memcpy(s->positions + 9 * i, s->positions + 9 * k, sizeof swap);
        memcpy(s->positions + 9 * k, swap, sizeof swap);
    }
}

glint_bvh_inputs test_tree_inputs(const test_soup *s, int width)
{
    return (glint_bvh_inputs){
        .positions = s->positions,
        .normals = s->normals,
        .material_of = s->material_of,
        .triangle_count = s->count,
        .width = width,
    };
}

glint_bvh test_tree_build(const test_soup *s, int width)
{
    glint_bvh bvh;
    glint_bvh_inputs in = test_tree_inputs(s, width);
    glint_error error = {0};
    assert_int_equal(glint_bvh_build(&in, &bvh, &error), GLINT_OK);
    return bvh;
}

int32_t test_tree_child(const glint_bvh *bvh, size_t node, int child)
{
    int32_t value;
    const float *base = bvh->nodes + node * GLINT_NODE_VALUES * (size_t)bvh->width;
    memcpy(&value, base + 6 * bvh->width + child, sizeof value);
    return value;
}

static void check_box(const float *p, const float low[3], const float high[3])
{
    for (int v = 0; v < 9; v++) {
        assert_true(p[v] >= low[v % 3] && p[v] <= high[v % 3]);
    }
}

// The values of one corner, [3][GLINT_CLUSTER_LANES], must equal the vertices bit for bit.
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

// No two vertices of a cluster may be equal. Unused entries repeat the first vertex.
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

static void check_cluster(test_walk *w, size_t index, const float low[3], const float high[3])
{
    const glint_cluster *cluster = &w->bvh->clusters[index];
    const float *normals = w->bvh->normals + index * GLINT_CLUSTER_NORMALS;
    const int32_t *numbers = w->bvh->numbers + index * GLINT_CLUSTER_LANES;
    assert_in_range(glint_cluster_count(cluster), 1, GLINT_CLUSTER_LANES);
    for (int lane = 0; lane < GLINT_CLUSTER_LANES; lane++) {
        if (lane >= glint_cluster_count(cluster)) {
            assert_int_equal(numbers[lane], -1);
            assert_int_equal(cluster->corners[0][lane] | cluster->corners[1][lane] |
                                 cluster->corners[2][lane],
                             0);
            continue;
        }
        assert_in_range(numbers[lane], 0, w->soup->count - 1);
        size_t triangle = (size_t)numbers[lane];
        assert_int_equal(w->seen[triangle]++, 0);
        assert_int_equal(w->soup->material_of[triangle], glint_cluster_material(cluster));
        for (int corner = 0; corner < 3; corner++) {
            size_t value = 9 * triangle + 3 * (size_t)corner;
            check_corner(cluster->positions[0], cluster, corner, lane, w->soup->positions + value);
            check_corner(normals, cluster, corner, lane, w->soup->normals + value);
        }
        check_box(w->soup->positions + 9 * triangle, low, high);
    }
    check_vertices(cluster, normals);
}

double test_half_area(const float low[3], const float high[3])
{
    double x = (double)high[0] - (double)low[0], y = (double)high[1] - (double)low[1];
    double z = (double)high[2] - (double)low[2];
    return x * y + y * z + z * x;
}

// A node with its box, and the largest number of entries on a traversal's stack there.
typedef struct visited {
    size_t node;
    const float *low, *high; // [3]
    int depth, waiting;
} visited;

static void visit(test_walk *w, const visited *at)
{
    const float *low = at->low, *high = at->high;
    const int waiting = at->waiting;
    int width = w->bvh->width, used = 0;
    const float *base = w->bvh->nodes + at->node * GLINT_NODE_VALUES * (size_t)width;
    w->nodes++;
    w->depth = at->depth + 1 > w->depth ? at->depth + 1 : w->depth;
    // Count the used children; unused children follow them.
    while (used < width && base[used] < GLINT_FAR) {
        used++;
    }
    assert_true(used >= 2 || at->node == 0);
    w->stack_need = waiting + used > w->stack_need ? waiting + used : w->stack_need;
    for (int c = 0; c < width; c++) {
        float child_low[3], child_high[3];
        int32_t child = test_tree_child(w->bvh, at->node, c);
        for (int k = 0; k < 3; k++) {
            child_low[k] = base[k * width + c];
            child_high[k] = base[(3 + k) * width + c];
        }
        // An unused child has an empty box.
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
        w->area += test_half_area(child_low, child_high);
        // Visit inner nodes; check clusters.
        if (child >= 0) {
            assert_in_range(child, 1, w->bvh->node_count - 1);
            visit(w, &(visited){(size_t)child, child_low, child_high, at->depth + 1,
                                waiting + used - 1});
            continue;
        }
        int32_t cluster = ~child;
        assert_in_range(cluster, 0, w->bvh->cluster_count - 1);
        w->clusters++;
        check_cluster(w, (size_t)cluster, child_low, child_high);
    }
}

static void check_report(const test_walk *w, const glint_bvh *bvh)
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

test_walk test_tree_check(const test_soup *s, const glint_bvh *bvh)
{
    test_walk w = {.soup = s, .bvh = bvh, .seen = calloc(s->count, 1)};
    assert_non_null(w.seen);
    const float low[3] = {-INFINITY, -INFINITY, -INFINITY};
    const float high[3] = {INFINITY, INFINITY, INFINITY};
    visit(&w, &(visited){0, low, high, 0, 0});
    for (size_t i = 0; i < s->count; i++) {
        assert_int_equal(w.seen[i], s->flat == NULL || !s->flat[i]);
    }
    assert_int_equal(w.nodes, bvh->node_count);
    assert_int_equal(w.clusters, bvh->cluster_count);
    check_report(&w, bvh);
    free(w.seen);
    return w;
}
