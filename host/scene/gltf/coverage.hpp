// Finds whether alpha ever counts.
#ifndef GLINT_SCENE_GLTF_COVERAGE_HPP
#define GLINT_SCENE_GLTF_COVERAGE_HPP

#include "scene/scene.h"

#include <cstdint>

namespace glint
{

// True if the material is glass with a volume, which is always all there, though its alphaMode says
// otherwise: BLEND with an alpha less than 1 somewhere, or MASK with one less than the cutoff.
// `number` is the material's in scene.material_of; `textures` may be NULL.
bool loses_alpha(const glint_scene &scene, const glint_textures *textures,
                 const glint_material &material, std::uint32_t number);

} // namespace glint

#endif
