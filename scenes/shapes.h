// Builds the shapes of the scenes. Each function adds a closed shape to a mesh, counter-clockwise
// from outside. The caller sets the mesh's `flat` before, if wanted.
#ifndef GLINT_SCENES_SHAPES_H
#define GLINT_SCENES_SHAPES_H

#include "mesh.h"

// Adds an icosphere: an icosahedron with each face divided into frequency² triangles, projected to
// the sphere. It is smooth and has 20 frequency² triangles and a vertex at each pole (0, ±radius,
// 0). Frequency 2^L is icosphere level L.
void shape_sphere(mesh *m, double radius, int frequency);

// Adds a box with the given half extents, flat: 12 triangles.
void shape_box(mesh *m, glint_vec3 centre, glint_vec3 half);

// Adds a convex box about the origin with edges and corners cut off at 45°, `chamfer` metres from
// each. Flat: 44 triangles.
void shape_chamfered_box(mesh *m, glint_vec3 half, double chamfer);

// Adds a prism along z, flat. The outline's corners run counter-clockwise seen from +z.
void shape_prism(mesh *m, const double (*outline)[2], int corners, double half_length);

// Adds a rectangle in the plane y = 0, facing +y: 2 triangles, open. Its node turns it.
void shape_sheet(mesh *m, double half_x, double half_z);

// Profile of a surface of revolution about +Y. It runs from the axis at the bottom, up along the
// outside, to the axis. The outside lies to the right of this path.
#define PROFILE_CAPACITY 256
typedef struct profile {
    int count;
    struct profile_point {
        double radius, height;
        double normal_radius, normal_height; // normal, outwards
    } points[PROFILE_CAPACITY];
} profile;

// Adds a straight piece. Each piece must start at the end of the last one. A change of direction
// makes a crease. Points past the capacity are dropped; this leaves the mesh open, so model_check
// reports it.
void profile_line(profile *p, double r0, double h0, double r1, double h1);

// Adds a cubic Bézier curve in `steps` pieces. It starts at the end of the last piece; `control`
// holds two control points and the end, each (radius, height).
void profile_curve(profile *p, const double control[3][2], int steps);

// Adds a circular arc about (r, h) between two angles in degrees. 0 points away from the axis, 90
// up. Counter-clockwise arcs bulge outwards.
void profile_arc(profile *p, const double centre[2], double radius, const double degrees[2],
                 int steps);

void shape_revolve(mesh *m, const profile *p, int sides);

// A smooth tube of radius `tube` around the (2, 3) torus knot, the trefoil. The knot lies in the
// plane z = 0 with one lobe up and two down. Its middle line runs on a torus of radii `ring` and
// `inner`.
typedef struct knot_shape {
    double ring, inner, tube;
    int along, around; // divisions
} knot_shape;
void shape_knot(mesh *m, const knot_shape *shape);

// A flat-shaded round brilliant with about Tolkowsky's proportions. The table faces +Y, and the
// lower edge of the girdle lies at y = 0. It has 57 facets and a girdle of 16.
typedef struct brilliant_shape {
    double girdle_radius;    // metres
    double girdle_height;    // in girdle radii
    double table;            // radius of the table's corners, in girdle radii
    double crown, pavilion;  // degrees between the main facets and the girdle's plane
    double star, lower_half; // facet lengths, as shares of the way to the girdle
} brilliant_shape;
void shape_brilliant(mesh *m, const brilliant_shape *shape);

#endif
