// Materials: checked, read, and surveyed for what is not modelled.
#ifndef GLINT_SCENE_GLTF_MATERIAL_HPP
#define GLINT_SCENE_GLTF_MATERIAL_HPP

#include "scene/gltf_tally.hpp"
#include "scene/gltf_texture.hpp"

#include <vector>

namespace glint
{

// Checks every material, used or not.
void check_materials(const json &root);

// A texture that cannot be shown, and why.
struct MissingTexture {
    glint_texture_slot slot;
    std::string key, why;
};

// A material that triangles use. Its name is left NULL.
struct UsedMaterial {
    glint_material material = {};
    std::vector<MissingTexture> missing;
    bool is_replaced = false; // by an override: what else the file says of it does not count
};

// The factors of a material of a checked document; of glTF's default material for −1.
glint_material read_factors(const json &root, std::ptrdiff_t index);

// The same with its textures: `image` of each is 1 + its place in the file's images.
UsedMaterial read_material(const json &root, std::ptrdiff_t index);

// Notes the images of the textures that are left, and sets `image` of each to its number there.
void note_images(UsedMaterial &used, Images &images);

// Once the images are read: puts something else in the place of textures that cannot be shown, and
// says so.
void settle_material(const json &root, std::ptrdiff_t index, const Images &images,
                     UsedMaterial &used, Tally &tally);

// Empty where it has none; of the default material, too.
std::string material_name(const json &root, std::ptrdiff_t index);

// What of a used material is not modelled, is added to the tally.
void survey_material(const json &root, std::ptrdiff_t index, const UsedMaterial &used,
                     Tally &tally);

} // namespace glint

#endif
