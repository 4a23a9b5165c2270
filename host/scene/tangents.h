// Tangents of surfaces whose file has none.
#ifndef GLINT_SCENE_TANGENTS_H
#define GLINT_SCENE_TANGENTS_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

// Computes the tangents of those triangles that have a normal texture and none, as MikkTSpace does
// (Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008): a vertex's tangent is the mean of
// those of the triangles around it that share its position, normal and texture coordinates and wind
// alike in the texture, each turned into the vertex's plane and weighted by its angle. Where the
// texture coordinates span no area there is none. The scene must have tangents among its
// attributes. False where memory runs out.
bool glint_scene_complete_tangents(glint_scene *scene);

#ifdef __cplusplus
}
#endif

#endif
