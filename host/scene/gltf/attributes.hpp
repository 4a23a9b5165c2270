// Stores the vertices' attributes besides position and normal.
#ifndef GLINT_SCENE_GLTF_ATTRIBUTES_HPP
#define GLINT_SCENE_GLTF_ATTRIBUTES_HPP

#include "scene/gltf/walk.hpp"

namespace glint
{

// Returns the attributes of the drawn primitives that the materials in use need.
glint_attributes attributes_of(const Load &load);

// Stores the attributes of a triangle with these vertices in the order of scene.attribute_set, [3]
// [stride] floats. Replaces values that are not finite, and tallies them.
void store_attributes(Load &load, const Draw &draw, const std::array<std::size_t, 3> &corners,
                      const glint_attributes &set, float *stored);

} // namespace glint

#endif
