// Makes meshes for the measurements by formula, with indexed vertices in double.
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
    glint_vec3 *normals;      // unit, owned; NULL before bench_mesh_smooth
    uint32_t (*triangles)[3]; // owned
} bench_mesh;

void bench_mesh_free(bench_mesh *mesh);

// Factor for a point's distance from the centre; `direction` is on the unit sphere. Spheres of
// different `phase` differ.
typedef double bench_displacement(glint_vec3 direction, double phase);

// 1 + 0.12 sin(5x + p) sin(4y + 1 + p) sin(6z + 2) + 0.03 sin(17x) sin(13y) sin(15z + p)
bench_displacement bench_bumps;

// A sphere: place, size and relief.
typedef struct bench_ball {
    glint_vec3 center;
    double radius; // metres
    bench_displacement *displacement;
    double phase;
} bench_ball;

// Adds an icosahedron with each face divided into frequency² triangles: 20 frequency² triangles. An
// odd factor of the frequency first divides the edges evenly. Each factor of 2 then halves the
// edges, with the midpoints projected to the sphere. So frequency 2^L gives the icosphere of level
// L.
glint_status bench_mesh_add_icosphere(bench_mesh *mesh, const bench_ball *ball, int frequency,
                                      glint_error *error);

// Adds a sphere of meridians and parallels about +Y: 2 around (bands − 1) triangles.
glint_status bench_mesh_add_latlong(bench_mesh *mesh, const bench_ball *ball, int around, int bands,
                                    glint_error *error);

// Adds a parallelogram of cells × cells quads, two triangles each. It faces along u × v.
typedef struct bench_sheet {
    glint_vec3 corner, u, v; // metres; u and v are the sides
    int cells;
} bench_sheet;
glint_status bench_mesh_add_sheet(bench_mesh *mesh, const bench_sheet *sheet, glint_error *error);

// Adds `count` slivers that grow out of the sphere and lean every way. Each has a base of `width`
// and a length of `length`, and normals as if its cross-section were round. The mesh must have
// normals, or be empty.
typedef struct bench_needles {
    size_t count;
    double radius, length, width; // metres
} bench_needles;
glint_status bench_mesh_add_needles(bench_mesh *mesh, const bench_needles *needles,
                                    glint_error *error);

// Sets each vertex normal to the unit sum of its triangles' normals, weighted by area.
glint_status bench_mesh_smooth(bench_mesh *mesh, glint_error *error);

#endif
