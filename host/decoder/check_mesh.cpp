// Validates meshes, primitives, their attributes and indices in the raw JSON. The accessors'
// contents are checked when they are read (scene/gltf/primitives.c). See check.hpp.
#include "decoder/check.hpp"
#include "decoder/check_morph.hpp"
#include "decoder/check_storage.hpp"
#include "decoder/draco.hpp"
#include "decoder/skin.hpp"
#include "decoder/variants.hpp"

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
    const std::size_t stride =
        accessor.bufferView < 0
            ? 0
            : model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
    if (stride != 0 && static_cast<int>(stride) != tinygltf::GetComponentSizeInBytes(
                                                       static_cast<std::uint32_t>(component))) {
        refuse(place, name + "'s bufferView has a byteStride (indices are packed tightly)");
    }
}

void check_attributes(const json &attributes, const Place &place, const Model &model,
                      tinygltf::Primitive &primitive)
{
    for (auto it = attributes.begin(); it != attributes.end(); ++it) {
        Place attribute = place / it.key().c_str();
        std::size_t index = index_of(it.value(), attribute, model.accessors.size(), "accessor");
        const tinygltf::Accessor &accessor = model.accessors[index];
        if (it.key() == "POSITION") {
            check_format(accessor, attribute, {TINYGLTF_TYPE_VEC3, true, false, model.quantized});
        } else if (it.key() == "NORMAL") {
            check_format(accessor, attribute, {TINYGLTF_TYPE_VEC3, true, model.quantized, false});
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

// ---- Once Draco's data is decoded ---------------------------------------------------------------

// An attribute that only textures and colours need.
struct Decoration {
    const char *name;
    std::vector<Format> formats;
    const char *kind, *instead; // for the note
};

std::vector<Decoration> decorations(const Model &model)
{
    const auto coordinates = [&](int type) {
        return Format{type, true, false, model.quantized, true};
    };
    const std::vector<Format> of_texcoords = {coordinates(TINYGLTF_TYPE_VEC2),
                                              coordinates(TINYGLTF_TYPE_VEC3),
                                              coordinates(TINYGLTF_TYPE_VEC4)};
    return {
        {"TEXCOORD_0", of_texcoords, "VEC2", "the coordinates count as 0"},
        {"TEXCOORD_1", of_texcoords, "VEC2", "the coordinates count as 0"},
        {"TANGENT",
         {{TINYGLTF_TYPE_VEC4, true, model.quantized, false}},
         "VEC4",
         "tangents are computed"},
        {"COLOR_0",
         {{TINYGLTF_TYPE_VEC3, true, false, false, true},
          {TINYGLTF_TYPE_VEC4, true, false, false, true}},
         "VEC3 or VEC4",
         "the vertices are white"},
    };
}

// A primitive, and the number of its vertices.
struct Settled {
    Model &model;
    std::pair<std::size_t, std::size_t> which; // mesh, number
    std::size_t vertices;

    tinygltf::Primitive &primitive() const
    {
        return model.meshes[which.first].primitives[which.second];
    }
    const tinygltf::Accessor &accessor(int index) const
    {
        return model.accessors[static_cast<std::size_t>(index)];
    }
};

// Leaves out a decoration that cannot be read.
void settle_decoration(const Settled &settled, const Decoration &decoration)
{
    auto &attributes = settled.primitive().attributes;
    const auto found = attributes.find(decoration.name);
    if (found == attributes.end()) {
        return;
    }
    const tinygltf::Accessor &accessor = settled.accessor(found->second);
    const bool is_readable =
        std::any_of(decoration.formats.begin(), decoration.formats.end(),
                    [&](const Format &format) { return has_format(accessor, format); });
    const std::string name = decoration.name;
    if (!is_readable || accessor.count != settled.vertices) {
        settled.model.note(settled.which,
                           name +
                               (is_readable ? " has another number of elements than POSITION"
                                            : std::string(" is not ") + decoration.kind +
                                                  " of floats or normalized integers") +
                               " and is left out: " + decoration.instead);
        attributes.erase(found);
    } else if (accessor.type != decoration.formats[0].type && name.compare(0, 5, "COLOR") != 0) {
        settled.model.note(settled.which, name + " has more than two components: the first two "
                                                 "count");
    }
}

void check_count(const Settled &settled, int index, const Place &place)
{
    const std::size_t count = settled.accessor(index).count;
    if (count != settled.vertices) {
        refuse(place, "accessors[" + std::to_string(index) + "] has " + counted(count, "element") +
                          ", POSITION has " + std::to_string(settled.vertices) +
                          " (they must agree)");
    }
}

// Checks what the shape needs.
void check_shape(const Settled &settled, const Place &place)
{
    const tinygltf::Primitive &primitive = settled.primitive();
    for (const auto &[name, index] : primitive.attributes) {
        if (name == "NORMAL" || name.compare(0, 7, "JOINTS_") == 0 ||
            name.compare(0, 8, "WEIGHTS_") == 0) {
            check_count(settled, index, place / "attributes" / name.c_str());
        }
    }
    for (std::size_t t = 0; t < primitive.targets.size(); t++) {
        for (const MorphRow &row : morph_rows) {
            const auto found = primitive.targets[t].find(row.name);
            if (found != primitive.targets[t].end()) {
                check_count(settled, found->second, (place / "targets")[t] / row.name);
            }
        }
    }
}

} // namespace

void settle_attributes(Model &model)
{
    const std::vector<Decoration> all = decorations(model);
    for (std::size_t m = 0; m < model.meshes.size(); m++) {
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); p++) {
            const auto &attributes = model.meshes[m].primitives[p].attributes;
            const auto position = attributes.find("POSITION");
            if (position == attributes.end()) {
                continue; // points or lines
            }
            const Settled settled = {
                model, {m, p}, model.accessors[static_cast<std::size_t>(position->second)].count};
            check_shape(settled, ((Place() / "meshes")[m] / "primitives")[p]);
            for (const Decoration &decoration : all) {
                settle_decoration(settled, decoration);
            }
        }
    }
}

void check_meshes(const json &root, Model &model)
{
    const json &meshes = objects_of(root, "meshes");
    for (std::size_t i = 0; i < meshes.size(); i++) {
        Place place = (Place() / "meshes")[i];
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
            MappedPrimitive mapped = read_variant_mappings(root, primitives[p], at, model);
            if (!mapped.materials.empty() || !mapped.fault.empty()) {
                mapped.mesh = i;
                mapped.number = p;
                model.mapped.push_back(std::move(mapped));
            }
            targets = std::max(targets, mesh.primitives.back().targets.size());
        }
        mesh.weights = check_weights(meshes[i], place);
        if (!mesh.weights.empty() && mesh.weights.size() != targets) {
            model.note({i, 0}, wrong_weights);
        }
    }
}

} // namespace glint
