// The labelled axes: an environment that says which way it faces.
#ifndef GLINT_ENVIRONMENT_AXES_H
#define GLINT_ENVIRONMENT_AXES_H

#include "base/status.h"
#include "base/vector.h"
#include "environment/cube.h"

// A cube of six colours seen from inside, its edges drawn, each side with its axis's name. The
// labels of the sides stand upright; +Y and −Y read upright for somebody who faces −Z, as the
// default camera does, and looks up or down: +Y has its lower edge towards −Z, −Y its upper edge.
// The colour along a direction of any length but zero; lines have an edge as wide as a pixel of
// `pixel` radians.
void glint_axes_color(glint_vec3 direction, double pixel, double rgb[3]);

// The same as a cube map. Errors: as glint_cube_create.
glint_status glint_axes_cube(int edge, glint_cube *cube, glint_error *error);

#endif
