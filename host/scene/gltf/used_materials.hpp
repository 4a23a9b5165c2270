// Reads the materials of drawn primitives.
#ifndef GLINT_SCENE_GLTF_USED_MATERIALS_HPP
#define GLINT_SCENE_GLTF_USED_MATERIALS_HPP

#include "scene/gltf/walk.hpp"

namespace glint
{

// Reads the materials of the chosen nodes' primitives, applies the overrides of `options`, and
// reads the images that the materials then need.
void read_used_materials(const glint_scene_options &options, Load &load);

} // namespace glint

#endif
