// Checks morph targets. See check_morph.hpp.
#include "decoder/check_morph.hpp"

#include "decoder/check_storage.hpp"

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

} // namespace glint
