// Tests whether points lie in convex position. It builds a bounding volume tree over them. For
// every point it searches for another point that is farther along its normal. See convexity.h.
//
// The bounding volumes are discs along the surface. Axis-aligned boxes would stick out of it by
// their own size, and a search would visit about the square root of all boxes. A disc that is
// turned against the searched normal by a small angle sticks out far less.
#include "scene/shape/convexity.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

#define LEAF_SIZE 8
// Enough: halving 2^64 points reaches leaves earlier.
#define DEEPEST 64

// A node of the implicit tree. Node i has the children 2i + 1 and 2i + 2; each holds half of its
// points. The points lie within `radius` of `center` and within [low, high] of it along `normal`.
typedef struct tree_node {
    glint_vec3 center;
    glint_vec3 normal; // unit, the mean of the points' normals; 0 if there is none
    double low, high, radius;
} tree_node;

typedef struct point_tree {
    glint_surface_point *points;
    size_t count;
    tree_node *nodes;
} point_tree;

// A node during construction or search: its number and its points [begin, end).
typedef struct tree_range {
    size_t node, begin, end;
} tree_range;

static tree_range child(tree_range parent, int which)
{
    size_t middle = parent.begin + (parent.end - parent.begin) / 2;
    return which == 0 ? (tree_range){2 * parent.node + 1, parent.begin, middle}
                      : (tree_range){2 * parent.node + 2, middle, parent.end};
}

static bool is_leaf(tree_range range)
{
    return range.end - range.begin <= LEAF_SIZE;
}

// Hoare's selection: moves points so that those before `middle` are not beyond it along the axis.
static void select_middle(glint_surface_point *points, tree_range range, int axis)
{
    size_t middle = range.begin + (range.end - range.begin) / 2;
    size_t low = range.begin;
    size_t high = range.end - 1;
    while (low < high) {
        // Partition the points from low to high around a pivot.
        float pivot = points[low + (high - low) / 2].position[axis];
        size_t i = low;
        size_t j = high;
        while (i <= j) {
            while (points[i].position[axis] < pivot) {
                i++;
            }
            while (points[j].position[axis] > pivot) {
                j--;
            }
            if (i <= j) {
                glint_surface_point swap = points[i];
                points[i++] = points[j];
                points[j] = swap;
                if (j == 0) {
                    break;
                }
                j--;
            }
        }
        // Continue on the side that holds the middle.
        if (middle <= j) {
            high = j;
        } else if (middle >= i) {
            low = i;
        } else {
            return;
        }
    }
}

static glint_vec3 vector_of(const float *p)
{
    return (glint_vec3){p[0], p[1], p[2]};
}

// Sets the node's volume. Returns the axis along which its points spread most.
static int enclose(const glint_surface_point *points, tree_range range, tree_node *node)
{
    float low[3] = {INFINITY, INFINITY, INFINITY};
    float high[3] = {-INFINITY, -INFINITY, -INFINITY};
    glint_vec3 normal = {0, 0, 0};
    for (size_t i = range.begin; i < range.end; i++) {
        const float *p = points[i].position;
        normal = glint_vec3_add(normal, points[i].normal);
        for (int k = 0; k < 3; k++) {
            low[k] = p[k] < low[k] ? p[k] : low[k];
            high[k] = p[k] > high[k] ? p[k] : high[k];
        }
    }
    node->normal = glint_vec3_normalize(normal);
    node->center = glint_vec3_scale(glint_vec3_add(vector_of(low), vector_of(high)), 0.5);
    node->low = INFINITY;
    node->high = -INFINITY;
    double squared = 0;
    for (size_t i = range.begin; i < range.end; i++) {
        glint_vec3 offset = glint_vec3_subtract(vector_of(points[i].position), node->center);
        double height = glint_vec3_dot(node->normal, offset);
        node->low = height < node->low ? height : node->low;
        node->high = height > node->high ? height : node->high;
        double square = glint_vec3_dot(offset, offset);
        squared = square > squared ? square : squared;
    }
    node->radius = sqrt(squared);
    int axis = high[1] - low[1] > high[0] - low[0] ? 1 : 0;
    return high[2] - low[2] > high[axis] - low[axis] ? 2 : axis;
}

static void build(point_tree *tree)
{
    tree_range stack[DEEPEST] = {{0, 0, tree->count}};
    for (size_t depth = 1; depth > 0;) {
        tree_range range = stack[--depth];
        int axis = enclose(tree->points, range, &tree->nodes[range.node]);
        if (!is_leaf(range)) {
            select_middle(tree->points, range, axis);
            stack[depth++] = child(range, 0);
            stack[depth++] = child(range, 1);
        }
    }
}

// An upper bound of how far the node's points reach along the unit vector.
static double farthest(const tree_node *node, glint_vec3 direction)
{
    double cosine = glint_vec3_dot(direction, node->normal);
    double sine = sqrt(fmax(0, 1 - cosine * cosine));
    return glint_vec3_dot(direction, node->center) +
           cosine * (cosine > 0 ? node->high : node->low) + sine * node->radius;
}

// True if some point is farther than `limit` along the unit vector.
static bool any_beyond(const point_tree *tree, glint_vec3 direction, double limit)
{
    tree_range stack[DEEPEST] = {{0, 0, tree->count}};
    for (size_t depth = 1; depth > 0;) {
        tree_range range = stack[--depth];
        if (farthest(&tree->nodes[range.node], direction) <= limit) {
            continue;
        }
        if (!is_leaf(range)) {
            stack[depth++] = child(range, 0);
            stack[depth++] = child(range, 1);
            continue;
        }
        for (size_t i = range.begin; i < range.end; i++) {
            if (glint_vec3_dot(direction, vector_of(tree->points[i].position)) > limit) {
                return true;
            }
        }
    }
    return false;
}

// The rounding error of the difference of two positions along the normal. `largest` holds the
// largest coordinates of all points.
static double tolerance(glint_vec3 normal, const float *position, glint_vec3 largest)
{
    double sum = fabs(normal.x) * (fabs((double)position[0]) + largest.x) +
                 fabs(normal.y) * (fabs((double)position[1]) + largest.y) +
                 fabs(normal.z) * (fabs((double)position[2]) + largest.z);
    return GLINT_POSITION_ROUNDINGS * ldexp(sum, -24);
}

static glint_vec3 largest_coordinates(const glint_surface_point *points, size_t count)
{
    glint_vec3 largest = {0, 0, 0};
    for (size_t i = 0; i < count; i++) {
        const float *p = points[i].position;
        largest =
            (glint_vec3){fmax(largest.x, fabs((double)p[0])), fmax(largest.y, fabs((double)p[1])),
                         fmax(largest.z, fabs((double)p[2]))};
    }
    return largest;
}

// The number of nodes, up to the last leaf of the deepest level.
static size_t node_count(size_t points)
{
    size_t count = 1;
    while (points > LEAF_SIZE) {
        points = points - points / 2;
        count = 2 * count + 1;
    }
    return count;
}

bool glint_points_are_extreme(glint_surface_point *points, size_t count)
{
    point_tree tree = {points, count, glint_allocate(node_count(count), sizeof *tree.nodes)};
    bool extreme = tree.nodes != NULL && count > 0;
    if (extreme) {
        build(&tree);
    }
    glint_vec3 largest = largest_coordinates(points, count);
    for (size_t i = 0; i < count && extreme; i++) {
        glint_vec3 normal = glint_vec3_normalize(points[i].normal);
        double limit = glint_vec3_dot(normal, vector_of(points[i].position)) +
                       tolerance(normal, points[i].position, largest);
        extreme = !any_beyond(&tree, normal, limit);
    }
    free(tree.nodes);
    return extreme;
}
