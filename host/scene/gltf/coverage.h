// Finds whether alpha ever counts.
#ifndef GLINT_SCENE_GLTF_COVERAGE_H
#define GLINT_SCENE_GLTF_COVERAGE_H

#include "scene/scene.h"

#include <stdint.h>

// True if the material is glass with a volume, which is always all there, though its alphaMode says
// otherwise: BLEND with an alpha less than 1 somewhere, or MASK with one less than the cutoff.
// `number` is the material's in scene->material_of; `textures` may be NULL.
bool glint_coverage_is_lost(const glint_scene *scene, const glint_textures *textures,
                            const glint_material *material, uint32_t number);

#endif
