// Checks skins. See skin.hpp.
#include "decoder/skin.hpp"

#include "decoder/check_storage.hpp"

namespace glint
{

namespace
{

void check_matrices(const json &skin, const Place &skin_place, const Model &model,
                    tinygltf::Skin &result)
{
    const std::ptrdiff_t index =
        optional_index(skin, skin_place, "inverseBindMatrices", model.accessors.size(), "accessor");
    result.inverseBindMatrices = static_cast<int>(index);
    if (index < 0) {
        return;
    }
    Place place = skin_place / "inverseBindMatrices";
    const tinygltf::Accessor &accessor = model.accessors[static_cast<std::size_t>(index)];
    check_format(accessor, place, {TINYGLTF_TYPE_MAT4, true, false, false});
    if (accessor.count < result.joints.size()) {
        refuse(place, "accessors[" + std::to_string(index) + "] has " +
                          counted(accessor.count, "element") + " for " +
                          counted(result.joints.size(), "joint") + " (each needs a matrix)");
    }
}

} // namespace

void check_skins(const json &root, Model &model)
{
    const json &skins = objects_of(root, "skins");
    const std::size_t nodes = objects_of(root, "nodes").size();
    for (std::size_t i = 0; i < skins.size(); i++) {
        Place place = (Place() / "skins")[i];
        tinygltf::Skin &skin = model.skins.emplace_back();
        const json &joints = array_at(skins[i], place, "joints");
        if (joints.empty()) {
            refuse(place / "joints", "empty (a skin has at least one joint)");
        }
        for (std::size_t j = 0; j < joints.size(); j++) {
            skin.joints.push_back(
                static_cast<int>(index_of(joints[j], (place / "joints")[j], nodes, "node")));
        }
        optional_index(skins[i], place, "skeleton", nodes, "node");
        check_matrices(skins[i], place, model, skin);
    }
}

void check_influences(const json &attributes, const Place &place, const Model &model)
{
    for (std::size_t set = 0;; set++) {
        const std::string joints = "JOINTS_" + std::to_string(set);
        const std::string weights = "WEIGHTS_" + std::to_string(set);
        const json *joint_index = member(attributes, joints.c_str());
        const json *weight_index = member(attributes, weights.c_str());
        if (joint_index == nullptr && weight_index == nullptr) {
            return; // sets are numbered without a gap
        }
        if (joint_index == nullptr || weight_index == nullptr) {
            const bool has_joints = joint_index != nullptr;
            refuse(place / (has_joints ? weights : joints).c_str(),
                   "missing beside " + (has_joints ? joints : weights) +
                       " (a skin needs both, or neither)");
        }
        const tinygltf::Accessor &numbers = model.accessors[joint_index->get<std::size_t>()];
        if (numbers.type != TINYGLTF_TYPE_VEC4 || numbers.normalized ||
            (numbers.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
             numbers.componentType != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)) {
            refuse(place / joints.c_str(),
                   "the accessor does not hold joints (VEC4 of 5121 or 5123, not normalized)");
        }
        check_format(model.accessors[weight_index->get<std::size_t>()], place / weights.c_str(),
                     {TINYGLTF_TYPE_VEC4, true, false, false, true});
    }
}

} // namespace glint
