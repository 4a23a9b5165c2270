// Axis-aligned bounds that grow.
#ifndef GLINT_SCENE_GLTF_BOUNDS_H
#define GLINT_SCENE_GLTF_BOUNDS_H

#include "base/vector.h"

#include <math.h>
#include <stdbool.h>

typedef struct glint_bounds {
    glint_vec3 low, high; // low > high: empty
} glint_bounds;

#define GLINT_BOUNDS_EMPTY                                                                         \
    ((glint_bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}})

static inline bool glint_bounds_are_empty(const glint_bounds *bounds)
{
    return !(bounds->low.x <= bounds->high.x);
}

// Ignores NaN.
static inline void glint_bounds_grow(glint_bounds *bounds, glint_vec3 p)
{
    bounds->low.x = p.x < bounds->low.x ? p.x : bounds->low.x;
    bounds->low.y = p.y < bounds->low.y ? p.y : bounds->low.y;
    bounds->low.z = p.z < bounds->low.z ? p.z : bounds->low.z;
    bounds->high.x = p.x > bounds->high.x ? p.x : bounds->high.x;
    bounds->high.y = p.y > bounds->high.y ? p.y : bounds->high.y;
    bounds->high.z = p.z > bounds->high.z ? p.z : bounds->high.z;
}

// Returns the largest extent.
static inline double glint_bounds_width(const glint_bounds *bounds)
{
    const double x = bounds->high.x - bounds->low.x, y = bounds->high.y - bounds->low.y;
    const double z = bounds->high.z - bounds->low.z, larger = x > y ? x : y;
    return larger > z ? larger : z;
}

#endif
