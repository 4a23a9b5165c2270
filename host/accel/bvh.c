// Builds the wide tree: a binary tree by the surface area heuristic over binned centroids (Wald, On
// fast Construction of SAH-based Bounding Volume Hierarchies, 2007), then collapsed by opening the
// largest child until a node is full. One thread, iterative, deterministic.
#include "accel/bvh.h"

#include "accel/cluster.h"
#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define BINS 32
#define MAX_WIDTH 16
// Below this depth splits are made in the middle: what bounds the depth on data that degrade the
// heuristic to a chain.
#define SAH_DEPTH_LIMIT 96
// Triangles of a cluster where 16 vertices are what fills it: as many as a compact patch of a mesh
// makes of them, as a vertex has six neighbours there and a patch many vertices on its rim.
#define CLUSTER_TRIANGLES 15

typedef struct box {
    float low[3], high[3];
} box;

typedef struct reference {
    box bounds;
    uint32_t triangle;
} reference;

// A node of the binary tree: `count` 0 is an inner node with children `first` and `first` + 1; else
// it is a leaf, the given cluster of the references from `first` on.
typedef struct binary_node {
    box bounds;
    uint32_t first, count, cluster;
} binary_node;

typedef struct builder {
    const glint_bvh_inputs *in;
    reference *references;
    binary_node *nodes;
    size_t node_count, cluster_count;
} builder;

static const box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static inline void grow(box *a, const box *b)
{
    for (int k = 0; k < 3; k++) {
        a->low[k] = b->low[k] < a->low[k] ? b->low[k] : a->low[k];
        a->high[k] = b->high[k] > a->high[k] ? b->high[k] : a->high[k];
    }
}

// Half of the surface area; 0 for an empty box.
static inline double half_area(const box *b)
{
    double x = (double)b->high[0] - (double)b->low[0], y = (double)b->high[1] - (double)b->low[1];
    double z = (double)b->high[2] - (double)b->low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

static inline float centroid(const reference *r, int axis)
{
    return 0.5f * r->bounds.low[axis] + 0.5f * r->bounds.high[axis];
}

static void make_references(const float *positions, size_t count, reference *references)
{
    for (size_t i = 0; i < count; i++) {
        const float *p = positions + 9 * i;
        reference *r = &references[i];
        for (int k = 0; k < 3; k++) {
            r->bounds.low[k] = fminf(p[k], fminf(p[3 + k], p[6 + k]));
            r->bounds.high[k] = fmaxf(p[k], fmaxf(p[3 + k], p[6 + k]));
        }
        r->triangle = (uint32_t)i;
    }
}

typedef struct split {
    int axis; // −1: none found
    int bin;  // the first bin of the right side
    double cost;
} split;

// What a bin number is computed from; the same for choosing and for partitioning.
typedef struct binning {
    float low[3], scale[3];
} binning;

static inline int bin_of(const binning *b, const reference *r, int axis)
{
    int bin = (int)((centroid(r, axis) - b->low[axis]) * b->scale[axis]);
    return bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
}

static binning make_binning(const builder *b, uint32_t first, uint32_t count)
{
    binning result;
    for (int axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY;
        for (uint32_t i = first; i < first + count; i++) {
            float c = centroid(&b->references[i], axis);
            low = fminf(low, c);
            high = fmaxf(high, c);
        }
        result.low[axis] = low;
        // 0 where all centroids are equal: everything falls into bin 0, and no split is found.
        result.scale[axis] = high > low ? (float)(BINS * (1 - 1e-6)) / (high - low) : 0;
        if (!isfinite(result.scale[axis])) {
            result.scale[axis] = 0;
        }
    }
    return result;
}

// What testing that many triangles costs: clusters, as all lanes of one are tested at once.
static double cost_of(uint32_t triangles)
{
    return (triangles + CLUSTER_TRIANGLES - 1) / CLUSTER_TRIANGLES;
}

// The cheapest split on one axis, from the counts and bounds of its bins.
static void sweep_axis(const box *bounds, const uint32_t *counts, int axis, split *best)
{
    double right_cost[BINS];
    box right = empty_box;
    uint32_t right_count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        grow(&right, &bounds[i]);
        right_count += counts[i];
        right_cost[i] = right_count > 0 ? half_area(&right) * cost_of(right_count) : INFINITY;
    }
    box left = empty_box;
    uint32_t left_count = 0;
    for (int i = 1; i < BINS; i++) {
        grow(&left, &bounds[i - 1]);
        left_count += counts[i - 1];
        double cost =
            left_count > 0 ? half_area(&left) * cost_of(left_count) + right_cost[i] : INFINITY;
        if (cost < best->cost) {
            *best = (split){axis, i, cost};
        }
    }
}

static split find_split(const builder *b, const binning *bins, uint32_t first, uint32_t count)
{
    static const int axes = 3;
    box bounds[3][BINS];
    uint32_t counts[3][BINS] = {{0}};
    for (int axis = 0; axis < axes; axis++) {
        for (int i = 0; i < BINS; i++) {
            bounds[axis][i] = empty_box;
        }
    }
    for (uint32_t i = first; i < first + count; i++) {
        const reference *r = &b->references[i];
        for (int axis = 0; axis < axes; axis++) {
            int bin = bin_of(bins, r, axis);
            grow(&bounds[axis][bin], &r->bounds);
            counts[axis][bin]++;
        }
    }
    split best = {-1, 0, INFINITY};
    for (int axis = 0; axis < axes; axis++) {
        sweep_axis(bounds[axis], counts[axis], axis, &best);
    }
    return best;
}

// Moves the references of the left side to the front; returns their number.
static uint32_t partition(builder *b, const binning *bins, const split *s, const binary_node *node)
{
    uint32_t left = node->first, right = node->first + node->count;
    while (left < right) {
        if (bin_of(bins, &b->references[left], s->axis) < s->bin) {
            left++;
        } else {
            right--;
            reference swap = b->references[left];
            b->references[left] = b->references[right];
            b->references[right] = swap;
        }
    }
    return left - node->first;
}

static box bounds_of(const builder *b, uint32_t first, uint32_t count)
{
    box bounds = empty_box;
    for (uint32_t i = first; i < first + count; i++) {
        grow(&bounds, &b->references[i].bounds);
    }
    return bounds;
}

static bool makes_cluster(const builder *b, const binary_node *node)
{
    uint32_t triangles[GLINT_CLUSTER_LANES];
    if (node->count > GLINT_CLUSTER_LANES) {
        return false;
    }
    for (uint32_t i = 0; i < node->count; i++) {
        triangles[i] = b->references[node->first + i].triangle;
    }
    return glint_cluster_fits(b->in, triangles, node->count);
}

// Decides whether a node is split, and where: the number of its left references, or 0 for a leaf.
static uint32_t divide(builder *b, const binary_node *node, int depth)
{
    if (makes_cluster(b, node)) {
        return 0;
    }
    if (depth < SAH_DEPTH_LIMIT) {
        binning bins = make_binning(b, node->first, node->count);
        split s = find_split(b, &bins, node->first, node->count);
        if (s.axis >= 0) {
            return partition(b, &bins, &s, node);
        }
    }
    // Nothing tells the triangles apart (equal centroids), or the tree is too deep: by number.
    return node->count / 2;
}

typedef struct task {
    uint32_t node;
    int depth;
} task;

static glint_status build_binary(builder *b, size_t count, glint_error *error)
{
    // A task is one level's right sibling; halving below the limit bounds the depth.
    task stack[SAH_DEPTH_LIMIT + 64];
    int size = 0;
    b->nodes[0] = (binary_node){bounds_of(b, 0, (uint32_t)count), 0, (uint32_t)count, 0};
    b->node_count = 1;
    stack[size++] = (task){0, 0};
    while (size > 0) {
        task next = stack[--size];
        binary_node *node = &b->nodes[next.node];
        uint32_t left = divide(b, node, next.depth);
        if (left == 0) {
            // The left child's task comes first: leaves are met from left to right.
            node->cluster = (uint32_t)b->cluster_count++;
            continue;
        }
        if (size + 2 > (int)(sizeof stack / sizeof *stack)) {
            return glint_fail(error, GLINT_BAD_INPUT, "the scene's tree grows too deep");
        }
        uint32_t child = (uint32_t)b->node_count;
        uint32_t first = node->first, right = node->count - left;
        b->nodes[child] = (binary_node){bounds_of(b, first, left), first, left, 0};
        b->nodes[child + 1] =
            (binary_node){bounds_of(b, first + left, right), first + left, right, 0};
        b->node_count += 2;
        node->first = child;
        node->count = 0;
        stack[size++] = (task){child + 1, next.depth + 1};
        stack[size++] = (task){child, next.depth + 1};
    }
    return GLINT_OK;
}

// ---- Collapse ----------------------------------------------------------------------------------

// Opens the largest inner child again and again, until there are `width` or all are leaves.
static int gather_children(const builder *b, uint32_t node, int width, uint32_t *children)
{
    int count = 0;
    if (b->nodes[node].count > 0) {
        children[count++] = node; // the root is a leaf
        return count;
    }
    children[count++] = b->nodes[node].first;
    children[count++] = b->nodes[node].first + 1;
    while (count < width) {
        int largest = -1;
        double largest_area = -1;
        for (int i = 0; i < count; i++) {
            const binary_node *child = &b->nodes[children[i]];
            double area = half_area(&child->bounds);
            if (child->count == 0 && area > largest_area) {
                largest = i;
                largest_area = area;
            }
        }
        if (largest < 0) {
            break;
        }
        uint32_t opened = b->nodes[children[largest]].first;
        children[largest] = opened;
        children[count++] = opened + 1;
    }
    return count;
}

// A child's box, wider by a few roundings of its own size: a large triangle's sheared vertices (see
// kernels/intersect.cl) are off by rounding errors of that order.
static void store_box(float *node, int width, int child, const box *bounds)
{
    float extent = 0;
    for (int k = 0; k < 3; k++) {
        extent = fmaxf(extent, bounds->high[k] - bounds->low[k]);
    }
    float margin = extent * 0x1p-21f;
    for (int k = 0; k < 3; k++) {
        node[k * width + child] = nextafterf(bounds->low[k] - margin, -INFINITY);
        node[(3 + k) * width + child] = nextafterf(bounds->high[k] + margin, INFINITY);
    }
}

typedef struct wide_task {
    uint32_t binary, wide;
    int depth, waiting; // nodes above; entries that a traversal may have waiting above
} wide_task;

// `first_wide` is the index of the first inner child's node; its siblings follow.
static void write_node(const builder *b, int width, const uint32_t *children, int count,
                       float *node, uint32_t first_wide)
{
    for (int i = 0; i < 6 * width; i++) {
        node[i] = GLINT_FAR;
    }
    for (int i = 0; i < width; i++) {
        int32_t value = 0;
        if (i < count) {
            const binary_node *child = &b->nodes[children[i]];
            store_box(node, width, i, &child->bounds);
            value = child->count > 0 ? ~(int32_t)child->cluster : (int32_t)first_wide++;
        }
        memcpy(node + 6 * width + i, &value, sizeof value);
    }
}

static void note_node(glint_bvh_report *report, const wide_task *at, int count)
{
    report->depth = at->depth + 1 > report->depth ? at->depth + 1 : report->depth;
    int need = at->waiting + count;
    report->stack_need = need > report->stack_need ? need : report->stack_need;
}

// Writes the wide nodes in depth-first order; `stack` has room for every inner binary node, of
// which each wide node stands for at least one. Without `bvh->nodes` it only counts them.
static void collapse(const builder *b, glint_bvh *bvh, wide_task *stack)
{
    const int width = bvh->width;
    const double root_area = fmax(half_area(&b->nodes[0].bounds), 1e-300);
    glint_bvh_report *report = &bvh->report;
    size_t size = 0;
    bvh->node_count = 1;
    stack[size++] = (wide_task){0, 0, 0, 0};
    while (size > 0) {
        wide_task at = stack[--size];
        uint32_t children[MAX_WIDTH];
        int count = gather_children(b, at.binary, width, children);
        note_node(report, &at, count);
        report->sah_cost += half_area(&b->nodes[at.binary].bounds) / root_area;
        uint32_t first_wide = (uint32_t)bvh->node_count;
        for (int i = 0; i < count; i++) {
            const binary_node *child = &b->nodes[children[i]];
            if (child->count > 0) {
                report->sah_cost += half_area(&child->bounds) / root_area;
            } else {
                uint32_t wide = (uint32_t)bvh->node_count++;
                stack[size++] =
                    (wide_task){children[i], wide, at.depth + 1, at.waiting + count - 1};
            }
        }
        if (bvh->nodes != NULL) {
            size_t values = GLINT_NODE_VALUES * (size_t)width;
            write_node(b, width, children, count, bvh->nodes + at.wide * values, first_wide);
        }
    }
}

// Every wide node but the root stands for at least one inner binary node.
static size_t count_inner(const builder *b)
{
    size_t inner = 0;
    for (size_t i = 0; i < b->node_count; i++) {
        inner += b->nodes[i].count == 0;
    }
    return inner > 0 ? inner : 1;
}

static glint_status make_wide(const builder *b, glint_bvh *bvh, glint_error *error)
{
    size_t inner = count_inner(b);
    size_t values = GLINT_NODE_VALUES * (size_t)bvh->width;
    wide_task *stack = glint_allocate(inner, sizeof *stack);
    if (stack == NULL) {
        return glint_fail_memory(error, "the tree");
    }
    collapse(b, bvh, stack);
    bvh->nodes = glint_allocate(bvh->node_count, values * sizeof(float));
    if (bvh->nodes == NULL) {
        free(stack);
        return glint_fail_memory(error, "the tree");
    }
    bvh->report = (glint_bvh_report){0};
    collapse(b, bvh, stack);
    free(stack);
    return GLINT_OK;
}

static glint_status make_clusters(const builder *b, glint_bvh *bvh, glint_error *error)
{
    bvh->cluster_count = b->cluster_count;
    bvh->clusters = glint_allocate(b->cluster_count, sizeof *bvh->clusters);
    bvh->numbers = glint_allocate(b->cluster_count, GLINT_CLUSTER_LANES * sizeof *bvh->numbers);
    if (b->in->normals != NULL) {
        bvh->normals =
            glint_allocate(b->cluster_count, GLINT_CLUSTER_NORMALS * sizeof *bvh->normals);
    }
    if (bvh->clusters == NULL || bvh->numbers == NULL ||
        (b->in->normals != NULL && bvh->normals == NULL)) {
        return glint_fail_memory(error, "the tree");
    }
    for (size_t i = 0; i < b->node_count; i++) {
        const binary_node *node = &b->nodes[i];
        uint32_t triangles[GLINT_CLUSTER_LANES];
        for (uint32_t k = 0; k < node->count; k++) {
            triangles[k] = b->references[node->first + k].triangle;
        }
        if (node->count > 0) {
            glint_cluster_fill(b->in, triangles, node->count, bvh, node->cluster);
        }
    }
    return GLINT_OK;
}

static void finish_report(glint_bvh *bvh, size_t triangle_count)
{
    const size_t node_bytes = GLINT_NODE_VALUES * (size_t)bvh->width * sizeof(float);
    const size_t normals = bvh->normals != NULL ? GLINT_CLUSTER_NORMALS * sizeof(float) : 0;
    const size_t numbers = GLINT_CLUSTER_LANES * sizeof(int32_t);
    glint_bvh_report *report = &bvh->report;
    report->triangle_count = triangle_count;
    report->node_count = bvh->node_count;
    report->cluster_count = bvh->cluster_count;
    report->fill = (double)triangle_count / ((double)bvh->cluster_count * GLINT_CLUSTER_LANES);
    report->bytes = bvh->node_count * node_bytes +
                    bvh->cluster_count * (sizeof(glint_cluster) + normals + numbers);
    report->bytes_per_triangle = (double)report->bytes / (double)triangle_count;
}

glint_status glint_bvh_build(const glint_bvh_inputs *in, glint_bvh *bvh, glint_error *error)
{
    const size_t count = in->triangle_count;
    *bvh = (glint_bvh){.width = in->width};
    if (count == 0) {
        return GLINT_OK;
    }
    if (count > GLINT_TRIANGLES_MAX) {
        return glint_fail(error, GLINT_BAD_INPUT,
                          "%zu triangles are more than this version can index (at most %u)", count,
                          GLINT_TRIANGLES_MAX);
    }
    builder b = {.in = in};
    glint_status status = GLINT_OK;
    b.references = glint_allocate(count, sizeof *b.references);
    b.nodes = glint_allocate(2 * count, sizeof *b.nodes);
    if (b.references == NULL || b.nodes == NULL) {
        status = glint_fail_memory(error, "building the tree");
        goto cleanup;
    }
    make_references(in->positions, count, b.references);
    status = build_binary(&b, count, error);
    if (status == GLINT_OK) {
        status = make_wide(&b, bvh, error);
    }
    if (status == GLINT_OK) {
        status = make_clusters(&b, bvh, error);
    }
    if (status == GLINT_OK) {
        finish_report(bvh, count);
    }
cleanup:
    free(b.references);
    free(b.nodes);
    if (status != GLINT_OK) {
        glint_bvh_free(bvh);
    }
    return status;
}

void glint_bvh_free(glint_bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->clusters);
    free(bvh->normals);
    free(bvh->numbers);
    *bvh = (glint_bvh){0};
}
