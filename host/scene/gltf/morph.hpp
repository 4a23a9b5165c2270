// Checks morph targets, opens them, and adds them to a primitive's attributes.
#ifndef GLINT_SCENE_GLTF_MORPH_HPP
#define GLINT_SCENE_GLTF_MORPH_HPP

#include "scene/gltf/accessor.hpp"

#include <array>
#include <vector>

namespace glint
{

// The attributes that targets move. To support another attribute, add a row.
enum MorphAttribute : std::size_t { morph_position, morph_normal };
struct MorphRow {
    const char *name;
    int type; // tinygltf's
    std::size_t components;
    bool any_integers; // with KHR_mesh_quantization: also integers that are not normalised
};
constexpr std::array<MorphRow, 2> morph_rows = {{
    {"POSITION", TINYGLTF_TYPE_VEC3, 3, true},
    {"NORMAL", TINYGLTF_TYPE_VEC3, 3, false},
}};

// The deltas of a target for each attribute, at weight 1. A reader without elements: no deltas.
struct MorphTarget {
    std::array<Reader, morph_rows.size()> of;
};

// Refuses targets whose accessors have the wrong kind or length. Fills primitive.targets.
void check_targets(const json &source, const Place &primitive_place, const Model &model,
                   tinygltf::Primitive &primitive);

// Returns the member "weights" of a mesh or a node. There should be one per target, or none;
// missing ones are 0.
std::vector<double> check_weights(const json &object, const Place &place);

// The note about other numbers of weights.
constexpr const char *wrong_weights =
    "there are not as many weights as morph targets (missing ones are 0)";

// The sum of targets times their weights. Targets of weight 0 cost nothing. Borrows the targets.
class Morph
{
  public:
    // Ignores weights past the last target; missing weights are 0.
    Morph(const std::vector<MorphTarget> &targets, const std::vector<double> &weights);

    bool moves(MorphAttribute attribute) const
    {
        return !parts_[attribute].empty();
    }

    // The number of targets that count, over all attributes.
    std::size_t part_count() const
    {
        std::size_t sum = 0;
        for (const std::vector<Part> &parts : parts_) {
            sum += parts.size();
        }
        return sum;
    }

    // Adds the deltas to the components of a vertex. Allocates nothing.
    void add(MorphAttribute attribute, std::size_t vertex, double *components) const;

  private:
    struct Part {
        double weight;
        const Reader *deltas;
    };
    std::array<std::vector<Part>, morph_rows.size()> parts_;
};

} // namespace glint

#endif
