// Maps whose colour encodes direction, rgb = ½ + ½ d: any look-up then tells where it looked. They
// are made from the layouts' own definitions, written out here, and share nothing with the code
// judged.
//
// Errors of a look-up in a map of this colour: along a great circle d has second derivative 1,
// across a face the gnomonic d(s, t) has at most 1.3 in any direction. Bilinear interpolation over
// cells of side h errs by at most h²/8 an axis of that: with h = 2/N, the colour's half, and both
// axes, ½ · 2 · 1.3 · (2/N)²/8 = 0.65/N² for one interpolation.
#ifndef GLINT_TESTS_DIRECTION_MAPS_H
#define GLINT_TESTS_DIRECTION_MAPS_H

#include "environment/environment.h"
#include "image/image.h"

#include <stdbool.h>

// Uniform in [−1, 1); the same sequence in every run.
double next_random(void);
glint_vec3 random_direction(void);

// The colour that a direction of any length has in these maps.
void color_of(glint_vec3 d, double rgb[3]);

// How far the look-up along d is from the direction's colour, the worst of three channels; ∞ where
// it is not finite. And the worst of many directions: random ones, axes, edges, corners and beside
// them.
double error_along(const glint_cube *cube, glint_vec3 d);
double worst_error(const glint_cube *cube);

// The bounds of that error: for a cube, over its edges and corners too, and for a lat-long map of
// this height.
double seam_bound(int edge);
double latlong_bound(int height, bool on_edges);

// OpenEXR's cube and lat-long map: the direction of a place in [0, 1] on a face, or in the map.
glint_vec3 openexr_cube_direction(int face, double column, double row);
glint_vec3 latlong_direction(double u, double v);

// OpenGL's table (its specification, "Cube Map Texture Selection"), posx negx posy negy posz negz:
// the vector (rx, ry, rz) that a place in [0, 1] of a face is looked up with, t = 0 its first row.
// The world's direction is (rx, ry, −rz).
glint_vec3 opengl_direction(int face, double s, double t);

// A lat-long map of directions, 2 height × height.
glint_image direction_latlong(int height, bool on_edges);

#endif
