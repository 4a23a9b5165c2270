// Checks and reads skins. See skin.hpp.
#include "scene/gltf/skin.hpp"

#include "scene/gltf/accessor.hpp"
#include "scene/gltf/check_storage.hpp"

#include <array>
#include <cmath>

namespace glint
{

namespace
{

// Tolerance of the last row, as for a node's matrix.
constexpr double row_tolerance = 1e-5;

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

glint_mat4 read_matrix(const glint_array &matrices, std::size_t i, const Place &place)
{
    std::array<double, 16> m{};
    glint_array_numbers(&matrices, i, 16, m.data());
    for (double value : m) {
        if (!std::isfinite(value)) {
            refuse(place, "matrix " + std::to_string(i) + " is not finite (the file is damaged)");
        }
    }
    if (std::fabs(m[3]) > row_tolerance || std::fabs(m[7]) > row_tolerance ||
        std::fabs(m[11]) > row_tolerance || std::fabs(m[15] - 1) > row_tolerance) {
        refuse(place, "the last row of matrix " + std::to_string(i) +
                          " is not 0 0 0 1 (glTF 2.0 requires it)");
    }
    glint_mat4 result = glint_mat4_identity;
    for (std::size_t k = 0; k < 16; k++) {
        if (k % 4 < 3) {
            result.m[k % 4][k / 4] = m[k]; // the file stores columns
        }
    }
    return result;
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

std::vector<Skin> read_skins(const Model &model)
{
    std::vector<Skin> skins;
    for (std::size_t i = 0; i < model.skins.size(); i++) {
        const tinygltf::Skin &source = model.skins[i];
        Skin &skin = skins.emplace_back();
        skin.joints.assign(source.joints.begin(), source.joints.end());
        skin.inverse_bind.assign(skin.joints.size(), glint_mat4_identity);
        if (source.inverseBindMatrices < 0) {
            continue;
        }
        const glint_array matrices =
            open_array(model, static_cast<std::size_t>(source.inverseBindMatrices));
        Place place = (Place() / "skins")[i] / "inverseBindMatrices";
        for (std::size_t j = 0; j < skin.joints.size(); j++) {
            skin.inverse_bind[j] = read_matrix(matrices, j, place);
        }
    }
    return skins;
}

} // namespace glint
