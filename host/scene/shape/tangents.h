// Computes tangents for surfaces whose file has none.
#ifndef GLINT_SCENE_SHAPE_TANGENTS_H
#define GLINT_SCENE_SHAPE_TANGENTS_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// Computes the tangents of triangles that have a normal texture but no tangents, as MikkTSpace does
// (Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008). A vertex's tangent is a weighted
// mean over the triangles around it. These triangles share its position, normal and texture
// coordinates, and wind the same way in the texture. Each triangle's tangent is turned into the
// vertex's plane and weighted by its angle. If the texture coordinates span no area, there is no
// tangent. The scene's attributes must include tangents. Returns false if memory is short.
bool glint_scene_complete_tangents(glint_scene *scene);

#ifdef __cplusplus
}
#endif

#endif
