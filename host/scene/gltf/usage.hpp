// Lists the glTF features that a file uses, and how glint treats each: `glint info` prints the
// table.
#ifndef GLINT_SCENE_GLTF_USAGE_HPP
#define GLINT_SCENE_GLTF_USAGE_HPP

#include "scene/gltf/walk.hpp"

namespace glint
{

// Sets the scene's usages. Call it after its materials are set.
void list_usages(const Load &load, glint_scene &scene);

} // namespace glint

#endif
