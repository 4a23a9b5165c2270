// Triangle meshes for the scenes: vertices shared by index, in double until they are written.
#ifndef GLINT_SCENES_MESH_H
#define GLINT_SCENES_MESH_H

#include "base/vector.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Zero is valid: an empty mesh. Triangles are counter-clockwise from outside. A call that finds no
// memory sets `failed` and later calls do nothing, so that a builder checks once, at the end.
typedef struct mesh {
    size_t vertex_count;
    glint_vec3 *positions; // metres, object space
    glint_vec3 *normals;   // unit, outwards; not written when `flat`
    size_t triangle_count;
    uint32_t (*triangles)[3];
    bool flat;   // faceted: written without normals, which glTF defines as flat shading
    bool open;   // a sheet, meant to have a boundary; a mesh that is not must be closed
    bool failed; // memory ran out on the way
} mesh;

void mesh_free(mesh *m);

// The new vertex's index. Position and normal are put on the grid of mesh_snap.
uint32_t mesh_add_vertex(mesh *m, glint_vec3 position, glint_vec3 normal);

// A triangle whose corners fall together is left out: it has no plane, and its edges cancel.
void mesh_add_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c);

// Two triangles: a b c, a c d.
void mesh_add_quad(mesh *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

// The nearest multiple of 2^−30, never −0, as a float: what the file will hold. The grid is there
// because the last bits of sin and cos differ between C libraries, most of all where they leave
// 10⁻¹⁷ of a zero, and the files are compared byte by byte.
double mesh_snap(double x);

// Joins vertices whose position and normal are equal; the first of each keeps its place in order.
void mesh_weld(mesh *m);

// Edges of welded positions that do not join exactly two triangles of opposite direction: 0 for a
// closed and consistently wound surface. SIZE_MAX when memory is short.
size_t mesh_count_boundary_edges(const mesh *m);

// Six times the signed volume: positive when a closed mesh is wound counter-clockwise from outside.
double mesh_signed_volume(const mesh *m);

// The lowest y of the mesh turned by the quaternion (x, y, z, w).
double mesh_lowest(const mesh *m, const double rotation[4]);

#endif
