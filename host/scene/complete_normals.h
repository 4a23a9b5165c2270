// Normals for every vertex, as shading at vertices needs them.
#ifndef GLINT_SCENE_COMPLETE_NORMALS_H
#define GLINT_SCENE_COMPLETE_NORMALS_H

#include "base/status.h"
#include "scene/scene.h"

// Writes to *normals, [triangle_count][3 vertices][3], unit, owned by the caller: the scene's own,
// turned to the side from which their triangle winds counter-clockwise, and that triangle's normal
// where one of its vertices has none, so that it is flat and shares no corner's normal with its
// neighbours. (0, 0, 0) for triangles whose area is 0 in double precision. NULL of a scene without
// triangles. Errors: GLINT_OUT_OF_MEMORY, *normals is then NULL.
glint_status glint_scene_complete_normals(const glint_scene *scene, float **normals,
                                          glint_error *error);

#endif
