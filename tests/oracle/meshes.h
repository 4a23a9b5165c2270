// Makes meshes for the tests with the oracle and of the oracle.
#ifndef GLINT_TESTS_ORACLE_MESHES_H
#define GLINT_TESTS_ORACLE_MESHES_H

#include "oracle/oracle.h"

// A mesh that grows as triangles are added. Starts as {0}. Aborts the test program if memory runs
// out.
typedef struct mesh {
    oracle_triangle *triangles;
    int count, capacity;
} mesh;

typedef struct mesh_ball {
    double centre[3], radius;
    int rows; // rows of latitude; there are twice as many columns
    bool smooth;
    int material;
} mesh_ball;

void mesh_free(mesh *m);

void mesh_add(mesh *m, const oracle_triangle *triangle);

// Flat-shaded. Corners run counter-clockwise seen from outside.
void mesh_add_triangle(mesh *m, const double corners[3][3], int material);
void mesh_add_quad(mesh *m, const double corners[4][3], int material);

// Adds a box that faces outward.
void mesh_add_box(mesh *m, const double low[3], const double high[3], int material);

// Adds a right prism from z = −depth to +depth. `corners` lie in the x, y plane, counter-clockwise
// seen from +Z.
void mesh_add_prism(mesh *m, const double corners[3][2], double depth, int material);

// Adds a ball with vertices on the sphere. With smooth normals n is exactly radial at every point.
void mesh_add_ball(mesh *m, const mesh_ball *ball);

// Reverses the winding and the normals of all triangles.
void mesh_turn_inside_out(mesh *m);

#endif
