// Makes spheres of triangles of nearly equal size.
#ifndef GLINT_SCENE_SHAPE_ICOSPHERE_H
#define GLINT_SCENE_SHAPE_ICOSPHERE_H

#include "base/vector.h"

#ifdef __cplusplus
extern "C" {
#endif

// Divides the triangles of an icosahedron into four, `level` times: 20 × 4^level triangles. Calls
// `triangle` with the corners of each (unit vectors, counter-clockwise from outside). A corner is
// the same for all triangles that share it, bit for bit.
void glint_icosphere(int level, void (*triangle)(void *context, const glint_vec3 corners[3]),
                     void *context);

#ifdef __cplusplus
}
#endif

#endif
