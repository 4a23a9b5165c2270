// Draws the labelled axes: an environment that shows which way it faces.
#ifndef GLINT_ENVIRONMENT_AXES_H
#define GLINT_ENVIRONMENT_AXES_H

#include "base/status.h"
#include "base/vector.h"
#include "environment/cube.h"

// Computes the colour along a direction of any length but zero. The environment is a cube of six
// colours, seen from inside. Its edges are drawn and each side shows the name of its axis. The
// labels of the four sides stand upright. The default camera faces −Z: when it looks up or down, it
// reads +Y and −Y upright. So the lower edge of +Y and the upper edge of −Y are towards −Z. Lines
// are anti-aliased over one pixel, `pixel` radians wide.
void glint_axes_color(glint_vec3 direction, double pixel, double rgb[3]);

// Draws the same environment as a cube map. Errors: as glint_cube_create.
glint_status glint_axes_cube(int edge, glint_cube *cube, glint_error *error);

#endif
