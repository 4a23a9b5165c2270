// What vertices hold beside position and normal.
#ifndef GLINT_SCENE_GLTF_ATTRIBUTES_HPP
#define GLINT_SCENE_GLTF_ATTRIBUTES_HPP

#include "scene/gltf_walk.hpp"

namespace glint
{

// Which attributes the materials in use need of what is drawn.
glint_attributes attributes_of(const Load &load);

// Stores the attributes of a triangle with these vertices as scene.attribute_set has them, [3]
// [stride] floats. Values that are not finite are replaced, and named in the tally.
void store_attributes(Load &load, const Draw &draw, const std::array<std::size_t, 3> &corners,
                      const glint_attributes &set, float *stored);

} // namespace glint

#endif
