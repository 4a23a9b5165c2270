// Flattening: every drawn triangle to world space, in double, and into the scene's arrays.
#ifndef GLINT_SCENE_GLTF_FLATTEN_HPP
#define GLINT_SCENE_GLTF_FLATTEN_HPP

#include "scene/gltf_walk.hpp"

namespace glint
{

// Refuses more triangles than a scene may have.
void check_triangle_count(std::size_t triangles);

// Fills all of the scene but its path, cameras and skipped counts.
void flatten(Load &load, glint_scene &scene);

} // namespace glint

#endif
