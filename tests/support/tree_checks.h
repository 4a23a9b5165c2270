// Makes triangles to build trees from, and checks the invariants of a tree.
#ifndef GLINT_TESTS_TREE_CHECKS_H
#define GLINT_TESTS_TREE_CHECKS_H

#include "accel/bvh.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct test_soup {
    float *positions, *normals; // [count][3][3]
    uint32_t *material_of;
    size_t count;
    const bool *flat; // marks triangles without area; NULL: none
    size_t flat_count;
} test_soup;

typedef struct test_walk {
    const test_soup *soup;
    const glint_bvh *bvh;
    unsigned char *seen; // by triangle
    size_t nodes, clusters;
    int depth, stack_need;
    double area; // sum over the boxes of nodes and clusters
} test_walk;

// Random numbers in [0, 1), the same on every machine.
double test_random(void);

// Makes triangles without positions, of one material, with the same normal at all vertices.
test_soup test_soup_empty(size_t count);
// Makes random small triangles. With a large `spread`, size and place span many orders of
// magnitude.
test_soup test_soup_random(size_t count, double spread);
// Makes a wavy sheet of 2 × edge² triangles with shared vertices.
test_soup test_soup_sheet(size_t edge);
// Shuffles the triangles, so that their order does not depend on their places.
void test_soup_shuffle(test_soup *s);
void test_soup_free(test_soup *s);

glint_bvh_inputs test_tree_inputs(const test_soup *s, int width);
glint_bvh test_tree_build(const test_soup *s, int width);
int32_t test_tree_child(const glint_bvh *bvh, size_t node, int child);

// Half of the surface area of a box.
double test_half_area(const float low[3], const float high[3]);

// Checks that every triangle with an area is in one cluster, inside every box above it, and that
// the report is true.
test_walk test_tree_check(const test_soup *s, const glint_bvh *bvh);

#endif
