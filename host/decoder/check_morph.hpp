// Checks morph targets.
#ifndef GLINT_DECODER_CHECK_MORPH_HPP
#define GLINT_DECODER_CHECK_MORPH_HPP

#include "decoder/json.hpp"
#include "decoder/model.hpp"

#include <array>
#include <vector>

namespace glint
{

// The attributes that targets move.
struct MorphRow {
    const char *name;
    int type;          // tinygltf's
    bool any_integers; // with KHR_mesh_quantization: also integers that are not normalised
};
constexpr std::array<MorphRow, 2> morph_rows = {{
    {"POSITION", TINYGLTF_TYPE_VEC3, true},
    {"NORMAL", TINYGLTF_TYPE_VEC3, false},
}};

// Refuses targets whose accessors have the wrong kind or length. Fills primitive.targets.
void check_targets(const json &source, const Place &primitive_place, const Model &model,
                   tinygltf::Primitive &primitive);

// Returns the member "weights" of a mesh or a node. There should be one per target, or none;
// missing ones are 0.
std::vector<double> check_weights(const json &object, const Place &place);

// The note about other numbers of weights.
constexpr const char *wrong_weights =
    "there are not as many weights as morph targets (missing ones are 0)";

} // namespace glint

#endif
