// Computes the bounds of a moving scene over its whole clip.
#ifndef GLINT_SCENE_GLTF_SWEEP_HPP
#define GLINT_SCENE_GLTF_SWEEP_HPP

#include "scene/gltf/bounds.hpp"
#include "scene/gltf/walk.hpp"

namespace glint
{

// Returns the bounds of everything drawn at any time, from the corners of the primitives' boxes. It
// evaluates nodes at rest once, and moving nodes at each key.
Bounds sweep(const Load &load);

} // namespace glint

#endif
