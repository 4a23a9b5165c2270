// Makes maps whose colour encodes direction, rgb = ½ + ½ d, so that any look-up tells its
// direction.
// The maps follow the layouts' own definitions, written out here, and share no code with glint.
//
// Error of a look-up: along a great circle d has second derivative 1. Across a face the gnomonic
// d(s, t) has at most 1.3 in any direction. Bilinear interpolation over cells of side h errs by at
// most h²/8 of this for each axis. With h = 2/N, the colour's half and both axes this gives
// ½ · 2 · 1.3 · (2/N)²/8 = 0.65/N² for one interpolation.
#ifndef GLINT_TESTS_DIRECTION_MAPS_H
#define GLINT_TESTS_DIRECTION_MAPS_H

#include "environment/environment.h"
#include "image/image.h"

#include <stdbool.h>

// Uniform in [−1, 1); the same sequence in every run.
double next_random(void);
glint_vec3 random_direction(void);

// Loads an environment. Fails the test, with the error, if it cannot.
glint_environment load_environment(const char *path, glint_layout layout, glint_warnings *warnings);

// The colour of a direction in these maps. The direction may have any length.
void color_of(glint_vec3 d, double rgb[3]);

// error_along: the difference between the look-up along d and the colour of d, the worst of three
// channels; ∞ if the look-up is not finite. worst_error: the worst over many directions: random
// ones, axes, edges, corners and their neighbourhoods.
double error_along(const glint_cube *cube, glint_vec3 d);
double worst_error(const glint_cube *cube);

// Bounds of this error: for a cube, including its edges and corners, and for a lat-long map of this
// height.
double seam_bound(int edge);
double latlong_bound(int height, bool on_edges);

// The direction at a place in [0, 1] of OpenEXR's cube face or lat-long map.
glint_vec3 openexr_cube_direction(int face, double column, double row);
glint_vec3 latlong_direction(double u, double v);

// The vector (rx, ry, rz) that OpenGL looks up at a place in [0, 1] of a face; t = 0 is the first
// row. Faces are posx negx posy negy posz negz ("Cube Map Texture Selection" in the specification).
// The direction in the world is (rx, ry, −rz).
glint_vec3 opengl_direction(int face, double s, double t);

// Makes a lat-long map of directions, 2 height × height.
glint_image direction_latlong(int height, bool on_edges);

#endif
