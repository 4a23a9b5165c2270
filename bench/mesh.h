// Meshes for the measurements, made by formula: vertices shared by index, in double.
#ifndef GLINT_BENCH_MESH_H
#define GLINT_BENCH_MESH_H

#include "base/status.h"
#include "base/vector.h"

#include <stddef.h>
#include <stdint.h>

// Zero is valid: an empty mesh. Triangles are counter-clockwise from outside.
typedef struct bench_mesh {
    size_t vertex_count, triangle_count;
    glint_vec3 *vertices;     // metres, owned
    glint_vec3 *normals;      // unit, owned; NULL: none yet, see bench_mesh_smooth
    uint32_t (*triangles)[3]; // owned
} bench_mesh;

void bench_mesh_free(bench_mesh *mesh);

// Where a point of the unit sphere goes, as a factor of its distance from the centre. `phase` makes
// spheres differ.
typedef double bench_displacement(glint_vec3 direction, double phase);

// 1 + 0.12 sin(5x + p) sin(4y + 1 + p) sin(6z + 2) + 0.03 sin(17x) sin(13y) sin(15z + p)
bench_displacement bench_bumps;

// What a sphere is made of: its place, its size and its relief.
typedef struct bench_ball {
    glint_vec3 center;
    double radius; // metres
    bench_displacement *displacement;
    double phase;
} bench_ball;

// Adds an icosahedron whose faces are divided into frequency² triangles: 20 frequency² triangles.
// Halves are taken by the middles of edges put on the sphere, so frequency 2^L is the icosphere of
// level L; an odd factor of the frequency divides the edges evenly before.
glint_status bench_mesh_add_icosphere(bench_mesh *mesh, const bench_ball *ball, int frequency,
                                      glint_error *error);

// Adds a sphere of meridians and parallels about +Y: 2 around (bands − 1) triangles.
glint_status bench_mesh_add_latlong(bench_mesh *mesh, const bench_ball *ball, int around, int bands,
                                    glint_error *error);

// Adds a parallelogram of cells × cells cells, two triangles each, that faces along u × v.
typedef struct bench_sheet {
    glint_vec3 corner, u, v; // metres; u and v are the sides
    int cells;
} bench_sheet;
glint_status bench_mesh_add_sheet(bench_mesh *mesh, const bench_sheet *sheet, glint_error *error);

// Adds `count` slivers that grow out of the sphere: base `width` wide, `length` long, leaning every
// way, with normals as if they were rounded across. The mesh must have normals, or be empty.
typedef struct bench_needles {
    size_t count;
    double radius, length, width; // metres
} bench_needles;
glint_status bench_mesh_add_needles(bench_mesh *mesh, const bench_needles *needles,
                                    glint_error *error);

// Gives every vertex the unit sum of its triangles' normals, each as long as twice the triangle's
// area.
glint_status bench_mesh_smooth(bench_mesh *mesh, glint_error *error);

#endif
