// Checks and reads materials, and warns of features that glint does not model.
#ifndef GLINT_SCENE_GLTF_MATERIAL_HPP
#define GLINT_SCENE_GLTF_MATERIAL_HPP

#include "scene/gltf/tally.hpp"
#include "scene/gltf/texture.hpp"

#include <vector>

namespace glint
{

// Checks the factors of every material, whether used or not.
void check_materials(const json &root);

// A texture that glint cannot show, and the reason.
struct MissingTexture {
    glint_texture_slot slot;
    std::string key;
    Note fault;
};

// A material that triangles use. Its name stays NULL.
struct UsedMaterial {
    glint_material material = {};
    std::vector<MissingTexture> missing;
    std::vector<Note> notes;  // of values that are taken otherwise
    bool is_replaced = false; // by an override: the file's other values no longer count
};

// Returns a material's factors from a checked document; −1: of glTF's default material.
glint_material read_factors(const json &root, std::ptrdiff_t index, std::vector<Note> &notes);

// Returns a material with its textures: each `image` is 1 + its place in the file's images.
UsedMaterial read_material(const json &root, std::ptrdiff_t index);

// Registers the images of the remaining textures, and sets each `image` to its number in `images`.
void note_images(UsedMaterial &used, Images &images);

// Leaves out textures that cannot be shown, and tallies them: their factors alone count, and
// nothing is emitted. Call it after the images are read.
void settle_material(const Images &images, UsedMaterial &used, Tally &tally);

// Returns the name; empty for a material without a name and for the default material.
std::string material_name(const json &root, std::ptrdiff_t index);

// Tallies features of a used material that glint does not model. `loses_alpha`: see
// coverage.h.
void survey_material(const json &root, std::ptrdiff_t index, const UsedMaterial &used,
                     bool loses_alpha, Tally &tally);

} // namespace glint

#endif
