// Intersects rays with triangles. It tries all of them, or uses a binary tree, which only saves
// time and finds the same hits.
#include "oracle/hit.h"

#include <float.h>
#include <limits.h>
#include <stdlib.h>

// The relative difference at which two distances count as equal. It is 16 roundings, at most, of a
// triangle's plane equation, amplified by up to 2⁸ at grazing incidence. Coincident faces are
// within it. Any gap that float positions can hold (2⁻²⁴) is 2¹⁶ times as wide.
#define TIE (16.0 * 256.0 * DBL_EPSILON)

// A start point on a triangle is the weighted mean of its vertices. It rounds in 3 products, 2 sums
// and the weights themselves: each half an ulp of the largest coordinate. Doubled for the other
// plane.
#define START_ERROR (16.0 * DBL_EPSILON)

enum { LEAF_SIZE = 4, TREE_STACK = 64 };

// An inner node has count 0 and its children at `first` and `first` + 1. A leaf has `count` entries
// of order[first…].
typedef struct node {
    vector low, high;
    int first, count;
} node;

struct oracle_tree {
    node *nodes;
    int *order;
    int node_count;
};

static vector corner(const oracle_triangle *triangle, int i)
{
    return vector_of(triangle->position[i]);
}

query oracle_query_from(const oracle_scene *scene, const oracle_ray *ray, int left)
{
    query q = {
        .origin = vector_of(ray->origin), .direction = vector_of(ray->direction), .left = left};
    for (int axis = 1; axis < 3; axis++)
        if (fabs(ray->direction[axis]) > fabs(ray->direction[q.along]))
            q.along = axis;
    for (int i = 0; i < 2; i++) {
        q.across[i] = (q.along + 1 + i) % 3;
        q.shear[i] = ray->direction[q.across[i]] / ray->direction[q.along];
    }
    if (left >= 0) {
        // The distance of the start point from the plane that it should lie in, at most.
        for (int i = 0; i < 3; i++)
            q.start_error =
                fmax(q.start_error, largest_magnitude(corner(&scene->triangles[left], i)));
        q.start_error *= START_ERROR;
    }
    return q;
}

// Projects a point along the ray: moves the ray's origin to 0 and shears its direction onto an
// axis.
static void project(const query *q, vector point, double seen[2])
{
    for (int i = 0; i < 2; i++)
        seen[i] = point.at[q->across[i]] - q->shear[i] * point.at[q->along];
}

// Twice the signed area of the triangle of 0, b and a. Products and their difference round
// monotonically, so the sign is right or the result is 0.
static double edge_function(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

// Intersects watertight (Woop, Benthin, Wald 2013), in double. Each vertex is projected once and in
// the same way for every triangle, and an edge function never has the wrong sign. So with "≥ 0" no
// ray passes between two triangles that share an edge or a vertex. (3D triple products do not
// ensure this at vertices.)
static bool meets(const query *q, const oracle_triangle *triangle, oracle_hit *hit)
{
    vector a = minus(corner(triangle, 0), q->origin);
    vector b = minus(corner(triangle, 1), q->origin);
    vector c = minus(corner(triangle, 2), q->origin);
    double seen_a[2], seen_b[2], seen_c[2];
    // Project the corners along the ray.
    project(q, a, seen_a);
    project(q, b, seen_b);
    project(q, c, seen_c);
    // Test the signs of the edge functions.
    double u = edge_function(seen_c, seen_b);
    double v = edge_function(seen_a, seen_c);
    double w = edge_function(seen_b, seen_a);
    bool all_in = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    double area = u + v + w;
    if (!all_in || area == 0.0 || !isfinite(area))
        return false; // NaN and edge-on triangles miss

    // Take the distance from the plane, by the corner nearest to the origin: it cancels least.
    vector across = cross(minus(b, a), minus(c, a));
    vector near = dot(a, a) <= dot(b, b) ? a : b;
    near = dot(c, c) < dot(near, near) ? c : near;
    double height = dot(across, near);
    double slope = dot(across, q->direction);
    if (slope == 0.0 || fabs(height) <= q->start_error * length(across))
        return false; // starts in this triangle's plane (a neighbour or a coincident face)
    hit->distance = height / slope;
    if (!(hit->distance > 0.0) || !isfinite(hit->distance))
        return false;
    // Weight the corners.
    hit->barycentric[0] = u / area;
    hit->barycentric[1] = v / area;
    hit->barycentric[2] = w / area;
    return true;
}

static void try_triangle(const oracle_scene *scene, const query *q, int index, oracle_hit *best)
{
    oracle_hit hit = {.triangle = index};
    if (index == q->left || !meets(q, &scene->triangles[index], &hit))
        return;
    bool nearer = hit.distance < best->distance * (1.0 - TIE);
    bool as_near = hit.distance <= best->distance * (1.0 + TIE);
    if (best->triangle < 0 || nearer || (as_near && index < best->triangle))
        *best = hit;
}

// Tests whether the ray passes the box, grown by the edge margin, before `limit`. A few ulp more
// keep rays that run in one of its faces.
static bool passes(const query *q, const node *box, double limit)
{
    double enter = 0.0, leave = limit;
    vector centre = scaled(plus(box->low, box->high), 0.5);
    vector half = scaled(minus(box->high, box->low), 0.5);
    double reach = length(minus(centre, q->origin)) + length(half);
    double grow = (q->margin + 8.0 * DBL_EPSILON) * reach +
                  8.0 * DBL_EPSILON * (largest_magnitude(q->origin) + largest_magnitude(centre));
    leave = leave * (1.0 + TIE) + grow;
    for (int axis = 0; axis < 3; axis++) {
        double low = box->low.at[axis] - grow - q->origin.at[axis];
        double high = box->high.at[axis] + grow - q->origin.at[axis];
        double d = q->direction.at[axis];
        if (d == 0.0) {
            if (low > 0.0 || high < 0.0)
                return false;
            continue;
        }
        double one = low / d, other = high / d;
        enter = fmax(enter, fmin(one, other));
        leave = fmin(leave, fmax(one, other));
    }
    return enter <= leave;
}

// Calls `visit` with every triangle whose box the ray passes before *limit, which may shrink.
static void visit_tree(const oracle_scene *scene, const query *q, visitor visit, void *state,
                       const double *limit)
{
    const oracle_tree *tree = scene->tree;
    int stack[TREE_STACK], top = 0;
    if (tree->node_count > 0)
        stack[top++] = 0;
    while (top > 0) {
        const node *box = &tree->nodes[stack[--top]];
        if (!passes(q, box, *limit))
            continue;
        for (int i = 0; i < box->count; i++)
            visit(scene, q, tree->order[box->first + i], state);
        if (box->count == 0) {
            stack[top++] = box->first + 1;
            stack[top++] = box->first;
        }
    }
}

void oracle_visit_triangles(const oracle_scene *scene, const query *q, visitor visit, void *state,
                            const double *limit)
{
    if (scene->tree) {
        visit_tree(scene, q, visit, state, limit);
        return;
    }
    for (int i = 0; i < scene->triangle_count; i++)
        visit(scene, q, i, state);
}

static void visit_for_hit(const oracle_scene *scene, const query *q, int index, void *state)
{
    try_triangle(scene, q, index, state);
}

oracle_hit oracle_closest_hit(const oracle_scene *scene, const oracle_ray *ray, int left)
{
    oracle_hit best = {.triangle = -1, .distance = INFINITY};
    query q = oracle_query_from(scene, ray, left);
    oracle_visit_triangles(scene, &q, visit_for_hit, &best, &best.distance);
    return best;
}

void oracle_each_hit(const oracle_scene *scene, const query *q, const double range[2], taker take,
                     void *state)
{
    for (int i = 0; i < scene->triangle_count; i++) {
        oracle_hit hit = {.triangle = i};
        if (meets(q, &scene->triangles[i], &hit) && hit.distance >= range[0] &&
            hit.distance <= range[1])
            take(state, &hit);
    }
}

// Building: nodes are halved by count along the longest axis of the centroids, down to LEAF_SIZE.
// The depth is log₂ of the count, so 64 levels suffice.

typedef struct entry {
    vector centroid;
    int index;
} entry;

typedef struct builder {
    const oracle_triangle *triangles;
    entry *entries;
    oracle_tree *tree;
} builder;

static int compare_on(const void *one, const void *other, int axis)
{
    const entry *a = one, *b = other;
    if (a->centroid.at[axis] != b->centroid.at[axis])
        return a->centroid.at[axis] < b->centroid.at[axis] ? -1 : 1;
    return (a->index > b->index) - (a->index < b->index);
}

static int compare_x(const void *one, const void *other)
{
    return compare_on(one, other, 0);
}

static int compare_y(const void *one, const void *other)
{
    return compare_on(one, other, 1);
}

static int compare_z(const void *one, const void *other)
{
    return compare_on(one, other, 2);
}

static void grow_box(vector *low, vector *high, vector point)
{
    for (int axis = 0; axis < 3; axis++) {
        low->at[axis] = fmin(low->at[axis], point.at[axis]);
        high->at[axis] = fmax(high->at[axis], point.at[axis]);
    }
}

static void build_node(builder *build, int at, int first, int count)
{
    static int (*const compare[3])(const void *, const void *) = {compare_x, compare_y, compare_z};
    vector empty_low = {{INFINITY, INFINITY, INFINITY}}, empty_high = scaled(empty_low, -1.0);
    node *box = &build->tree->nodes[at];
    *box = (node){empty_low, empty_high, first, count};
    vector low = empty_low, high = empty_high;
    for (int i = first; i < first + count; i++) {
        const entry *member = &build->entries[i];
        grow_box(&low, &high, member->centroid);
        for (int k = 0; k < 3; k++)
            grow_box(&box->low, &box->high, corner(&build->triangles[member->index], k));
    }
    if (count <= LEAF_SIZE)
        return;
    vector extent = minus(high, low);
    int axis = extent.at[1] > extent.at[0] ? 1 : 0;
    axis = extent.at[2] > extent.at[axis] ? 2 : axis;
    qsort(&build->entries[first], (size_t)count, sizeof(entry), compare[axis]);

    int child = build->tree->node_count;
    build->tree->node_count += 2;
    *box = (node){box->low, box->high, child, 0};
    build_node(build, child, first, count / 2);
    build_node(build, child + 1, first + count / 2, count - count / 2);
}

oracle_tree *oracle_tree_create(const oracle_triangle *triangles, int triangle_count)
{
    size_t count = triangle_count > 0 ? (size_t)triangle_count : 0;
    builder build = {triangles, calloc(count + 1, sizeof(entry)), calloc(1, sizeof(oracle_tree))};
    if (!build.entries || !build.tree)
        goto failed;
    build.tree->nodes = calloc(2 * count + 1, sizeof(node));
    build.tree->order = calloc(count + 1, sizeof(int));
    if (!build.tree->nodes || !build.tree->order)
        goto failed;
    for (int i = 0; i < triangle_count; i++) {
        vector sum = plus(corner(&triangles[i], 0), corner(&triangles[i], 1));
        sum = plus(sum, corner(&triangles[i], 2));
        build.entries[i] = (entry){scaled(sum, 1.0 / 3.0), i};
    }
    if (triangle_count > 0) {
        build.tree->node_count = 1;
        build_node(&build, 0, 0, triangle_count);
    }
    for (int i = 0; i < triangle_count; i++)
        build.tree->order[i] = build.entries[i].index;
    free(build.entries);
    return build.tree;
failed:
    free(build.entries);
    oracle_tree_free(build.tree);
    return NULL;
}

void oracle_tree_free(oracle_tree *tree)
{
    if (!tree)
        return;
    free(tree->nodes);
    free(tree->order);
    free(tree);
}
