// Validation of the raw JSON: meshes, primitives, their attributes and indices. What the accessors
// hold is checked when it is read (gltf_primitive.cpp). See gltf_check.hpp.
#include "scene/gltf_check.hpp"

namespace glint
{

namespace
{

void check_indices(const json &root, const json &primitive, const Place &primitive_place)
{
    const json &accessors = objects_of(root, "accessors");
    std::ptrdiff_t index =
        optional_index(primitive, primitive_place, "indices", accessors.size(), "accessor");
    if (index < 0) {
        return;
    }
    Place place = primitive_place / "indices";
    const json &accessor = accessors[static_cast<std::size_t>(index)];
    std::string name = "accessors[" + std::to_string(index) + "]";
    auto component = accessor["componentType"].get<std::uint64_t>();
    bool is_unsigned = component == 5121 || component == 5123 || component == 5125;
    if (accessor["type"].get_ref<const std::string &>() != "SCALAR" || !is_unsigned ||
        optional_boolean(accessor, place, "normalized", false)) {
        refuse(place, name + " does not hold indices (SCALAR of 5121, 5123 or 5125, not "
                             "normalized)");
    }
    const json *view = member(accessor, "bufferView");
    if (view != nullptr && member(objects_of(root, "bufferViews")[view->get<std::size_t>()],
                                  "byteStride") != nullptr) {
        refuse(place, name + "'s bufferView has a byteStride (indices are packed tightly)");
    }
}

void check_attributes(const json &root, const json &attributes, const Place &place,
                      const Checked &checked)
{
    const json &accessors = objects_of(root, "accessors");
    const json *position = member(attributes, "POSITION");
    std::uint64_t vertices = 0;
    if (position != nullptr) {
        std::size_t index = index_of(*position, place / "POSITION", accessors.size(), "accessor");
        vertices = accessors[index]["count"].get<std::uint64_t>();
    }
    for (auto it = attributes.begin(); it != attributes.end(); ++it) {
        Place attribute = place / it.key().c_str();
        std::size_t index = index_of(it.value(), attribute, accessors.size(), "accessor");
        const json &accessor = accessors[index];
        auto count = accessor["count"].get<std::uint64_t>();
        if (position != nullptr && count != vertices) {
            refuse(attribute, "accessors[" + std::to_string(index) + "] has " +
                                  counted(count, "element") + ", POSITION has " +
                                  std::to_string(vertices) + " (they must agree)");
        }
        if (it.key() == "POSITION") {
            check_format(accessor, attribute, {"VEC3", true, false, checked.quantized});
        } else if (it.key() == "NORMAL") {
            check_format(accessor, attribute, {"VEC3", true, checked.quantized, false});
        }
    }
}

void check_primitive(const json &root, const json &primitive, const Place &place,
                     const Checked &checked)
{
    if (!primitive.is_object()) {
        refuse(place, "not an object (glTF 2.0 requires one)");
    }
    std::uint64_t mode = optional_whole(primitive, place, "mode", 4, 6);
    optional_index(primitive, place, "material", objects_of(root, "materials").size(), "material");
    const json &attributes = object_at(primitive, place, "attributes");
    check_attributes(root, attributes, place / "attributes", checked);
    if (mode >= 4 && member(attributes, "POSITION") == nullptr) {
        refuse(place / "attributes" / "POSITION",
               "missing (without positions there is nothing to draw)");
    }
    check_indices(root, primitive, place);
    const json &targets = optional_array(primitive, place, "targets");
    for (std::size_t i = 0; i < targets.size(); i++) {
        Place target = (place / "targets")[i];
        if (!targets[i].is_object()) {
            refuse(target, "not an object (glTF 2.0 requires one)");
        }
        for (auto it = targets[i].begin(); it != targets[i].end(); ++it) {
            index_of(it.value(), target / it.key().c_str(), objects_of(root, "accessors").size(),
                     "accessor");
        }
    }
    optional_object(primitive, place, "extensions");
}

} // namespace

void check_format(const json &accessor, const Place &place, const Format &format)
{
    auto component = accessor["componentType"].get<std::uint64_t>();
    const auto &type = accessor["type"].get_ref<const std::string &>();
    bool normalized = optional_boolean(accessor, place, "normalized", false);
    bool good = format.plain_float && component == 5126;
    good =
        good || (format.normalized_ints && normalized && (component == 5120 || component == 5122));
    good = good || (format.unsigned_ints && normalized && (component == 5121 || component == 5123));
    good = good || (format.quantized && component >= 5120 && component <= 5123);
    if (!good || type != format.type) {
        std::string wanted = std::string(format.type) + " of floats (5126)";
        if (format.normalized_ints || format.quantized) {
            wanted += ", bytes or shorts";
        }
        refuse(place, "the accessor holds " + type + " of component type " +
                          std::to_string(component) + (normalized ? ", normalized" : "") +
                          " (it must be " + wanted + ")");
    }
}

void check_meshes(const json &root, const Checked &checked)
{
    const json &meshes = objects_of(root, "meshes");
    for (std::size_t i = 0; i < meshes.size(); i++) {
        Place place = (Place() / "meshes")[i];
        optional_text(meshes[i], place, "name");
        const json &primitives = array_at(meshes[i], place, "primitives");
        if (primitives.empty()) {
            refuse(place / "primitives", "empty (a mesh has at least one primitive)");
        }
        for (std::size_t p = 0; p < primitives.size(); p++) {
            check_primitive(root, primitives[p], (place / "primitives")[p], checked);
        }
    }
}

} // namespace glint
