// Meshes for the tests that the oracle judges or that judge the oracle.
#ifndef GLINT_TESTS_ORACLE_MESHES_H
#define GLINT_TESTS_ORACLE_MESHES_H

#include "oracle/oracle.h"

// Grows as triangles are added; aborts the test program if memory runs out. Starts as {0}.
typedef struct mesh {
    oracle_triangle *triangles;
    int count, capacity;
} mesh;

typedef struct mesh_ball {
    double centre[3], radius;
    int rows; // of latitude; twice as many columns
    bool smooth;
    int material;
} mesh_ball;

void mesh_free(mesh *m);

void mesh_add(mesh *m, const oracle_triangle *triangle);

// Flat; corners counter-clockwise seen from outside.
void mesh_add_triangle(mesh *m, const double corners[3][3], int material);
void mesh_add_quad(mesh *m, const double corners[4][3], int material);

// Faces outward.
void mesh_add_box(mesh *m, const double low[3], const double high[3], int material);

// A right prism: `corners` in the x, y plane, counter-clockwise seen from +Z; from z = −depth to
// +depth.
void mesh_add_prism(mesh *m, const double corners[3][2], double depth, int material);

// Vertices on the sphere. With smooth normals, so n is exactly radial at every point.
void mesh_add_ball(mesh *m, const mesh_ball *ball);

// Turns every triangle's winding around, and the normals.
void mesh_turn_inside_out(mesh *m);

#endif
