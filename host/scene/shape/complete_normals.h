// Computes a normal for every vertex, as shading at vertices needs.
#ifndef GLINT_SCENE_SHAPE_COMPLETE_NORMALS_H
#define GLINT_SCENE_SHAPE_COMPLETE_NORMALS_H

#include "base/status.h"
#include "scene/scene.h"

// Writes unit normals to *normals, [triangle_count][3 vertices][3], owned by the caller. They are
// the scene's own normals, turned to the side from which their triangle winds counter-clockwise. If
// a vertex of a triangle has no normal, all three get the triangle's normal: it is flat and shares
// no corner's normal with its neighbours. Triangles whose area is 0 in double precision get (0, 0,
// 0). *normals is NULL for a scene without triangles. Errors: GLINT_OUT_OF_MEMORY, *normals is then
// NULL.
glint_status glint_scene_complete_normals(const glint_scene *scene, float **normals,
                                          glint_error *error);

#endif
