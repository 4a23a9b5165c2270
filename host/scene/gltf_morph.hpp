// Morph targets: checked, opened, and added to a primitive's attributes.
#ifndef GLINT_SCENE_GLTF_MORPH_HPP
#define GLINT_SCENE_GLTF_MORPH_HPP

#include "scene/gltf_accessor.hpp"

#include <array>
#include <vector>

namespace glint
{

// The attributes that targets move. A row is all that another one needs to be checked, opened and
// morphed.
enum MorphAttribute : std::size_t { morph_position, morph_normal };
struct MorphRow {
    const char *name;
    int type; // tinygltf's
    std::size_t components;
    bool any_integers; // with KHR_mesh_quantization: also those that are not normalised
};
constexpr std::array<MorphRow, 2> morph_rows = {{
    {"POSITION", TINYGLTF_TYPE_VEC3, 3, true},
    {"NORMAL", TINYGLTF_TYPE_VEC3, 3, false},
}};

// What a target adds to each attribute where its weight is 1. A reader without elements: nothing.
struct MorphTarget {
    std::array<Reader, morph_rows.size()> of;
};

// Refuses targets whose accessors are of the wrong kind or length. Fills primitive.targets.
void check_targets(const json &source, const Place &primitive_place, const Model &model,
                   tinygltf::Primitive &primitive);

// The member "weights" of a mesh or a node: as many as there are targets, or none.
std::vector<double> check_weights(const json &object, const Place &place, std::size_t targets);

// The sum of targets times their weights. Targets of weight 0 are left out, so they cost nothing.
// Borrows the targets.
class Morph
{
  public:
    // Weights past the last target are not used; those that are missing are 0.
    Morph(const std::vector<MorphTarget> &targets, const std::vector<double> &weights);

    bool moves(MorphAttribute attribute) const
    {
        return !parts_[attribute].empty();
    }

    // Targets that count, of all attributes.
    std::size_t part_count() const
    {
        std::size_t sum = 0;
        for (const std::vector<Part> &parts : parts_) {
            sum += parts.size();
        }
        return sum;
    }

    // Adds to the components of a vertex. Allocates nothing.
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
