// Validates meshes, primitives, their attributes and indices in the raw JSON. The accessors'
// contents are checked when they are read (gltf_primitive.cpp). See gltf_check.hpp.
#include "scene/gltf_check.hpp"
#include "scene/gltf_check_storage.hpp"
#include "scene/gltf_draco.hpp"
#include "scene/gltf_morph.hpp"
#include "scene/gltf_skin.hpp"
#include "scene/gltf_variants.hpp"

#include <algorithm>
#include <utility>

namespace glint
{

namespace
{

void check_indices(const json &source, const Place &primitive_place, const Model &model,
                   tinygltf::Primitive &primitive)
{
    std::ptrdiff_t index =
        optional_index(source, primitive_place, "indices", model.accessors.size(), "accessor");
    primitive.indices = static_cast<int>(index);
    if (index < 0) {
        return;
    }
    Place place = primitive_place / "indices";
    const tinygltf::Accessor &accessor = model.accessors[static_cast<std::size_t>(index)];
    std::string name = "accessors[" + std::to_string(index) + "]";
    const int component = accessor.componentType;
    bool is_unsigned = component == 5121 || component == 5123 || component == 5125;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_unsigned || accessor.normalized) {
        refuse(place, name + " does not hold indices (SCALAR of 5121, 5123 or 5125, not "
                             "normalized)");
    }
    if (accessor.bufferView >= 0 &&
        model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride != 0) {
        refuse(place, name + "'s bufferView has a byteStride (indices are packed tightly)");
    }
}

// Checks an attribute that textures and colours need.
void check_attribute(const std::string &name, const tinygltf::Accessor &accessor,
                     const Place &place, const Model &model)
{
    if (name == "TEXCOORD_0" || name == "TEXCOORD_1") {
        check_format(accessor, place, {TINYGLTF_TYPE_VEC2, true, false, model.quantized, true});
    } else if (name == "TANGENT") {
        check_format(accessor, place, {TINYGLTF_TYPE_VEC4, true, model.quantized, false});
    } else if (name == "COLOR_0") {
        const bool has_alpha = accessor.type == TINYGLTF_TYPE_VEC4;
        check_format(
            accessor, place,
            {has_alpha ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3, true, false, false, true});
    }
}

void check_attributes(const json &attributes, const Place &place, const Model &model,
                      tinygltf::Primitive &primitive)
{
    const json *position = member(attributes, "POSITION");
    std::uint64_t vertices = 0;
    if (position != nullptr) {
        vertices = model
                       .accessors[index_of(*position, place / "POSITION", model.accessors.size(),
                                           "accessor")]
                       .count;
    }
    for (auto it = attributes.begin(); it != attributes.end(); ++it) {
        Place attribute = place / it.key().c_str();
        std::size_t index = index_of(it.value(), attribute, model.accessors.size(), "accessor");
        const tinygltf::Accessor &accessor = model.accessors[index];
        if (position != nullptr && accessor.count != vertices) {
            refuse(attribute, "accessors[" + std::to_string(index) + "] has " +
                                  counted(accessor.count, "element") + ", POSITION has " +
                                  std::to_string(vertices) + " (they must agree)");
        }
        if (it.key() == "POSITION") {
            check_format(accessor, attribute, {TINYGLTF_TYPE_VEC3, true, false, model.quantized});
        } else if (it.key() == "NORMAL") {
            check_format(accessor, attribute, {TINYGLTF_TYPE_VEC3, true, model.quantized, false});
        } else {
            check_attribute(it.key(), accessor, attribute, model);
        }
        primitive.attributes[it.key()] = static_cast<int>(index);
    }
    check_influences(attributes, place, model);
}

tinygltf::Primitive check_primitive(const json &root, const json &source, const Place &place,
                                    const Model &model)
{
    if (!source.is_object()) {
        refuse(place, "not an object (glTF 2.0 requires one)");
    }
    tinygltf::Primitive primitive;
    primitive.mode = static_cast<int>(optional_whole(source, place, "mode", 4, 6));
    primitive.material = static_cast<int>(optional_index(
        source, place, "material", objects_of(root, "materials").size(), "material"));
    const json &attributes = object_at(source, place, "attributes");
    check_attributes(attributes, place / "attributes", model, primitive);
    if (primitive.mode >= 4 && member(attributes, "POSITION") == nullptr) {
        refuse(place / "attributes" / "POSITION",
               "missing (without positions there is nothing to draw)");
    }
    check_indices(source, place, model, primitive);
    check_targets(source, place, model, primitive);
    optional_object(source, place, "extensions");
    return primitive;
}

} // namespace

void check_meshes(const json &root, Model &model)
{
    const json &meshes = objects_of(root, "meshes");
    for (std::size_t i = 0; i < meshes.size(); i++) {
        Place place = (Place() / "meshes")[i];
        optional_text(meshes[i], place, "name");
        const json &primitives = array_at(meshes[i], place, "primitives");
        if (primitives.empty()) {
            refuse(place / "primitives", "empty (a mesh has at least one primitive)");
        }
        tinygltf::Mesh &mesh = model.meshes.emplace_back();
        std::size_t &targets = model.target_counts.emplace_back(0);
        for (std::size_t p = 0; p < primitives.size(); p++) {
            const Place at = (place / "primitives")[p];
            mesh.primitives.push_back(check_primitive(root, primitives[p], at, model));
            check_draco(primitives[p], at, model);
            VariantMaterials mapped = check_variant_mappings(root, primitives[p], at, model);
            if (!mapped.empty()) {
                model.mapped.push_back({i, p, std::move(mapped)});
            }
            targets = std::max(targets, mesh.primitives.back().targets.size());
        }
        mesh.weights = check_weights(meshes[i], place, targets);
    }
}

} // namespace glint
