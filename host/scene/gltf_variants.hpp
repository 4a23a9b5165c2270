// KHR_materials_variants: several sets of materials in one file, of which one is shown.
#ifndef GLINT_SCENE_GLTF_VARIANTS_HPP
#define GLINT_SCENE_GLTF_VARIANTS_HPP

#include "scene/gltf_json.hpp"
#include "scene/gltf_model.hpp"
#include "scene/scene.h"

namespace glint
{

// The names that the file lists, into model.variants. Refuses names that are missing or not texts.
void check_variants(const json &root, Model &model);

// What a primitive's mappings say, by variant. Refuses indices that refer to nothing, and a variant
// that two of the mappings claim.
VariantMaterials check_variant_mappings(const json &root, const json &primitive, const Place &place,
                                        const Model &model);

// Gives the primitives the materials of a variant, by its name or index. Primitives that say
// nothing of it keep their plain material. NULL: all keep theirs. Refuses unknown names.
void choose_variant(const char *name, Model &model);

// Copies the variants' names to a scene, and which one it shows.
void name_variants(const Model &model, glint_scene &scene);

} // namespace glint

#endif
