// Finds the root nodes that a scene shows.
#ifndef GLINT_SCENE_GLTF_ROOTS_HPP
#define GLINT_SCENE_GLTF_ROOTS_HPP

#include "scene/gltf/walk.hpp"

namespace glint
{

// Returns a node's name for warnings: nodes[3] "wheel".
std::string node_where(const Load &load, std::size_t node);

// Returns the roots of a scene, each once. `name` is a scene's name or index; NULL: the file's
// default. Warns of nodes that no scene should list.
std::vector<int> find_roots(Load &load, const char *name);

} // namespace glint

#endif
