// What a scene that moves takes up over the whole of its clip.
#ifndef GLINT_SCENE_GLTF_SWEEP_HPP
#define GLINT_SCENE_GLTF_SWEEP_HPP

#include "scene/gltf_bounds.hpp"
#include "scene/gltf_walk.hpp"

namespace glint
{

// Bounds of all that is drawn at any time, by the corners of the primitives' boxes. Nodes that stay
// where they are are looked at once, others at each key.
Bounds sweep(const Load &load);

} // namespace glint

#endif
