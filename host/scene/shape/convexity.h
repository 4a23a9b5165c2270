// Tests whether points lie in convex position, up to a float's rounding.
#ifndef GLINT_SCENE_SHAPE_CONVEXITY_H
#define GLINT_SCENE_SHAPE_CONVEXITY_H

#include "base/vector.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// The allowed error of a coordinate, in roundings of a float. Positions in files carry the rounding
// of several float operations; errors of 7 times the last rounding occur.
#define GLINT_POSITION_ROUNDINGS 16

typedef struct glint_surface_point {
    float position[3];
    glint_vec3 normal; // outwards, of any length: the point should be the farthest this way
} glint_surface_point;

// True if every point is the farthest of all points along its normal, up to the roundings of
// coordinates. For a closed body's vertices, with sums of adjacent normals, this proves that no
// vertex lies in a hollow, even in a very shallow hollow. Reorders the points. O(n log n) for
// convex bodies. Also returns false if memory is short: nothing is proved.
bool glint_points_are_extreme(glint_surface_point *points, size_t count);

#ifdef __cplusplus
}
#endif

#endif
