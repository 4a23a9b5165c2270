// Spheres of triangles of nearly equal size.
#ifndef GLINT_SCENE_ICOSPHERE_H
#define GLINT_SCENE_ICOSPHERE_H

#include "base/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

// Calls `triangle` with the corners (unit vectors, counter-clockwise from outside) of each triangle
// of an icosahedron that has been quartered `level` times: 20 × 4^level in all. A corner that
// triangles share is the same for all of them, bit for bit.
void glint_icosphere(int level, void (*triangle)(void *context, const glint_vec3 corners[3]),
                     void *context);

#ifdef __cplusplus
}
#endif

#endif
