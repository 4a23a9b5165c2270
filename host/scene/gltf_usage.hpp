// What a file uses of glTF, and what is made of it: the table that `glint info` prints.
#ifndef GLINT_SCENE_GLTF_USAGE_HPP
#define GLINT_SCENE_GLTF_USAGE_HPP

#include "scene/gltf_walk.hpp"

namespace glint
{

// Sets the scene's usages, once its materials are there.
void list_usages(const Load &load, glint_scene &scene);

} // namespace glint

#endif
