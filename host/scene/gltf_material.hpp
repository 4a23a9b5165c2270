// Materials: checked, read, and surveyed for what is not modelled.
#ifndef GLINT_SCENE_GLTF_MATERIAL_HPP
#define GLINT_SCENE_GLTF_MATERIAL_HPP

#include "scene/gltf_json.hpp"
#include "scene/gltf_tally.hpp"
#include "scene/scene.h"

#include <vector>

namespace glint
{

// Checks every material, used or not.
void check_materials(const json &root);

// The material of a checked document (its name left NULL); glTF's default material for −1.
glint_material read_material(const json &root, std::ptrdiff_t index);

// Its name; empty where it has none.
std::string material_name(const json &root, std::ptrdiff_t index);

// What of a used material is not modelled, is added to the tally.
void survey_material(const json &root, std::ptrdiff_t index, Tally &tally);

// Likewise of a material that the command line has replaced whole.
void survey_override(const glint_material &material, Tally &tally);

} // namespace glint

#endif
