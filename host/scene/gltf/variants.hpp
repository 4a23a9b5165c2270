// KHR_materials_variants: chooses one of several sets of materials in a file.
#ifndef GLINT_SCENE_GLTF_VARIANTS_HPP
#define GLINT_SCENE_GLTF_VARIANTS_HPP

#include "scene/gltf/json.hpp"
#include "scene/gltf/model.hpp"
#include "scene/scene.h"

namespace glint
{

// Reads the variants' names into model.variants; none if the list cannot be read.
void read_variants(const json &root, Model &model);

// Returns a primitive's materials by variant, without its mesh and number. Its fault says why some
// could not be read.
MappedPrimitive read_variant_mappings(const json &root, const json &primitive, const Place &place,
                                      const Model &model);

// Gives the primitives the materials of a variant, by name or index. A primitive without a mapping
// for it keeps its plain material. NULL: all keep theirs. Refuses unknown names; notes faults.
void choose_variant(const char *name, Model &model);

// Copies the variants' names and the chosen variant to a scene.
void name_variants(const Model &model, glint_scene &scene);

} // namespace glint

#endif
