// Checks and applies morph targets. See morph.hpp.
#include "scene/gltf/morph.hpp"

#include "scene/gltf/check_storage.hpp"

#include <algorithm>

namespace glint
{

void check_targets(const json &source, const Place &primitive_place, const Model &model,
                   tinygltf::Primitive &primitive)
{
    const json &targets = optional_array(source, primitive_place, "targets");
    for (std::size_t i = 0; i < targets.size(); i++) {
        Place place = (primitive_place / "targets")[i];
        expect_object(targets[i], place);
        auto &target = primitive.targets.emplace_back();
        for (auto it = targets[i].begin(); it != targets[i].end(); ++it) {
            Place attribute = place / it.key().c_str();
            std::size_t index = index_of(it.value(), attribute, model.accessors.size(), "accessor");
            target[it.key()] = static_cast<int>(index);
            const auto *row =
                std::find_if(morph_rows.begin(), morph_rows.end(),
                             [&](const MorphRow &one) { return it.key() == one.name; });
            if (row == morph_rows.end()) {
                continue;
            }
            const tinygltf::Accessor &accessor = model.accessors[index];
            check_format(accessor, attribute,
                         {row->type, true, model.quantized, row->any_integers && model.quantized});
        }
    }
}

std::vector<double> check_weights(const json &object, const Place &place)
{
    std::vector<double> weights;
    const json &numbers = optional_array(object, place, "weights");
    weights.reserve(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); i++) {
        weights.push_back(number_of(numbers[i], (place / "weights")[i]));
    }
    return weights;
}

Morph::Morph(const std::vector<MorphTarget> &targets, const std::vector<double> &weights)
{
    for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); i++) {
        for (std::size_t row = 0; row < morph_rows.size() && weights[i] != 0; row++) {
            if (targets[i].of[row].count() > 0) {
                parts_[row].push_back({weights[i], &targets[i].of[row]});
            }
        }
    }
}

void Morph::add(MorphAttribute attribute, std::size_t vertex, double *components) const
{
    std::array<double, 4> delta{};
    const std::size_t count = morph_rows[attribute].components;
    for (const Part &part : parts_[attribute]) {
        part.deltas->numbers(vertex, count, delta.data());
        for (std::size_t k = 0; k < count; k++) {
            components[k] += part.weight * delta[k];
        }
    }
}

} // namespace glint
