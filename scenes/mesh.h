// Builds triangle meshes for the scenes: indexed vertices, in double until they are written.
#ifndef GLINT_SCENES_MESH_H
#define GLINT_SCENES_MESH_H

#include "base/vector.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A mesh. Zero is valid: empty. Triangles are counter-clockwise from outside. A call that finds no
// memory sets `failed`, and later calls do nothing. So a builder checks once, at the end.
typedef struct mesh {
    size_t vertex_count;
    glint_vec3 *positions; // metres, object space
    glint_vec3 *normals;   // unit, outwards; not written when `flat`
    size_t triangle_count;
    uint32_t (*triangles)[3];
    bool flat;   // faceted: written without normals, which glTF defines as flat shading
    bool open;   // a sheet with a boundary; all other meshes must be closed
    bool failed; // memory ran out
} mesh;

void mesh_free(mesh *m);

// Adds a vertex and returns its index. Rounds position and normal by mesh_snap.
uint32_t mesh_add_vertex(mesh *m, glint_vec3 position, glint_vec3 normal);

// Adds a triangle. Drops it if two corners coincide: it has no plane, and its edges cancel.
void mesh_add_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c);

// Adds two triangles: a b c, a c d.
void mesh_add_quad(mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

// Rounds to the nearest multiple of 2^−30, never −0, as a float: the value in the file. The last
// bits of sin and cos differ between C libraries, most of all where they give 10⁻¹⁷ instead of
// zero. The rounding removes these differences, because tests compare the files byte by byte.
double mesh_snap(double x);

// Joins vertices with equal position and normal. The first of each group keeps its place.
void mesh_weld(mesh *m);

// Counts edges that do not join exactly two triangles of opposite direction, with vertices welded
// by position. 0: the surface is closed and consistently wound. SIZE_MAX: memory is short.
size_t mesh_count_boundary_edges(const mesh *m);

// Six times the signed volume. Positive: the closed mesh is counter-clockwise from outside.
double mesh_signed_volume(const mesh *m);

// The lowest y of the mesh, rotated by the quaternion (x, y, z, w).
double mesh_lowest(const mesh *m, const double rotation[4]);

#endif
