// The materials of what is drawn.
#ifndef GLINT_SCENE_GLTF_USED_MATERIALS_HPP
#define GLINT_SCENE_GLTF_USED_MATERIALS_HPP

#include "scene/gltf_walk.hpp"

namespace glint
{

// Reads the materials that the chosen nodes' primitives name, changes them as `options` asks, and
// reads the images that they need then.
void read_used_materials(const glint_scene_options &options, Load &load);

} // namespace glint

#endif
