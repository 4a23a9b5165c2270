// Whether points lie in convex position, up to a float's rounding.
#ifndef GLINT_SCENE_CONVEXITY_H
#define GLINT_SCENE_CONVEXITY_H

#include "base/vector.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

// How many roundings of a float a coordinate may be off. Positions in files carry the rounding of
// some operations in float; seen are 7 times the last one's.
#define GLINT_POSITION_ROUNDINGS 16

typedef struct glint_surface_point {
    float position[3];
    glint_vec3 normal; // outwards, of any length: the direction in which it should be the farthest
} glint_surface_point;

// True if every point is the farthest of all along its normal, up to the roundings of coordinates.
// Of a closed body's vertices, with sums of adjacent normals, this says that none lies in a hollow,
// however gently the surface bends into it. Reorders the points. O(n log n) for convex bodies.
// False also when memory is short: not proved.
bool glint_points_are_extreme(glint_surface_point *points, size_t count);

#ifdef __cplusplus
}
#endif

#endif
