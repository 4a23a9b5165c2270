// Judges the openings of solids: which of them matter; only solids.c uses it.
#ifndef GLINT_SCENE_SHAPE_OPENINGS_H
#define GLINT_SCENE_SHAPE_OPENINGS_H

#include "scene/shape/topology.h"

#include <stdbool.h>

// `is_open` [component] marks the solids that are open. Clears the marks of those whose opening
// changes no picture:
// - Opaque surfaces close it: they share all edges of its boundary.
// - It is the level surface of a liquid, and light does not get around it. Either opaque surfaces
//   hold its boundary, or nothing is lower than it and beside it.
// Returns false if memory is short; all marks then stay.
bool glint_openings_judge(const glint_scene *scene, const glint_topology *topology, bool *is_open);

#endif
