// The shapes that the scenes are made of. Each adds to a mesh, closed and counter-clockwise from
// outside, centred where it says; a mesh's `flat` is set by the caller before, where wanted.
#ifndef GLINT_SCENES_SHAPES_H
#define GLINT_SCENES_SHAPES_H

#include "mesh.h"

// An icosahedron whose triangles are divided into frequency² each, put on the sphere: 20 frequency²
// triangles, smooth, a vertex at each pole (0, ±radius, 0). Frequency 2^L is icosphere level L.
void shape_sphere(mesh *m, double radius, int frequency);

// A box of the given half extents, flat: 12 triangles.
void shape_box(mesh *m, glint_vec3 centre, glint_vec3 half);

// The same with its edges and corners cut off at 45°, `chamfer` metres from each, flat: 44
// triangles. Convex.
void shape_chamfered_box(mesh *m, glint_vec3 half, double chamfer);

// A prism along z, flat: the outline's corners counter-clockwise seen from +z.
void shape_prism(mesh *m, const double (*outline)[2], int corners, double half_length);

// A rectangle in the plane y = 0, facing +y, open: 2 triangles. Turned by its node.
void shape_sheet(mesh *m, double half_x, double half_z);

// A surface of revolution about +Y is drawn by its profile, from the axis at the bottom, up along
// the outside, to the axis: the outside lies to the right of the way.
#define PROFILE_CAPACITY 256
typedef struct profile {
    int count;
    struct profile_point {
        double radius, height;
        double normal_radius, normal_height; // outwards
    } points[PROFILE_CAPACITY];
} profile;

// Pieces that follow each other start where the last one ended; where their directions differ there
// is a crease. Points past the capacity are dropped, which leaves the mesh open and is found there.
void profile_line(profile *p, double r0, double h0, double r1, double h1);

// A cubic Bézier curve in `steps` pieces, from where the last piece ended over two control points
// to its end, each (radius, height).
void profile_curve(profile *p, const double control[3][2], int steps);

// A circular arc about (r, h) from one angle to the other in degrees, 0 pointing away from the axis
// and 90 up; counter-clockwise turns bulge outwards.
void profile_arc(profile *p, const double centre[2], double radius, const double degrees[2],
                 int steps);

void shape_revolve(mesh *m, const profile *p, int sides);

// A tube of radius `tube` around the (2, 3) torus knot, the trefoil, smooth. It lies in the plane
// z = 0 with one lobe up and two down; the middle line runs on a torus of radii `ring` and `inner`.
typedef struct knot_shape {
    double ring, inner, tube;
    int along, around; // divisions
} knot_shape;
void shape_knot(mesh *m, const knot_shape *shape);

// A round brilliant cut by its proportions (Tolkowsky's, about), flat. The table faces +Y, the
// girdle's lower edge lies at y = 0; 57 facets and a girdle of 16.
typedef struct brilliant_shape {
    double girdle_radius;    // metres
    double girdle_height;    // in girdle radii
    double table;            // the table's corners, in girdle radii
    double crown, pavilion;  // degrees between the main facets and the girdle's plane
    double star, lower_half; // lengths of those facets, as shares of the way to the girdle
} brilliant_shape;
void shape_brilliant(mesh *m, const brilliant_shape *shape);

#endif
