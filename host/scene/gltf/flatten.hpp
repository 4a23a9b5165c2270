// Flattens the scene: transforms every drawn triangle to world space, in double, and stores it.
#ifndef GLINT_SCENE_GLTF_FLATTEN_HPP
#define GLINT_SCENE_GLTF_FLATTEN_HPP

#include "scene/gltf/walk.hpp"

namespace glint
{

// Refuses more triangles than a scene may have.
void check_triangle_count(std::size_t triangles);

// Fills the scene except its path, cameras and skipped counts.
void flatten(Load &load, glint_scene &scene);

} // namespace glint

#endif
