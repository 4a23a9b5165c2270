// Stores the vertices' attributes besides position and normal.
#ifndef GLINT_SCENE_GLTF_ATTRIBUTES_H
#define GLINT_SCENE_GLTF_ATTRIBUTES_H

#include "scene/gltf/corners.h"

// Returns the attributes of the drawn primitives that the materials in use need.
glint_attributes glint_attributes_needed(const glint_load *load);

// Stores the attributes of a vertex of the file in the order of `set`, [stride] floats. Replaces
// values that are not finite, and tallies them.
void glint_attributes_store(glint_load *load, const glint_draw *draw, size_t vertex,
                            const glint_attributes *set, float *stored);

#endif
