// Writes a model as a document: nodes, meshes, and what else has few fields. See compose.hpp.
#include "decoder/compose.hpp"

#include "decoder/arrays.hpp"
#include "decoder/check_morph.hpp"
#include "decoder/clips.hpp"
#include "decoder/extensions.hpp"
#include "decoder/material.hpp"
#include "decoder/texture.hpp"
#include "scene/lights.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace glint
{

namespace
{

using Texts = std::vector<std::string>;

// Appends notes about the object that holds them.
void add_all(std::vector<Note> &notes, const Texts &texts)
{
    for (const std::string &text : texts) {
        notes.push_back({"", text});
    }
}

// ---- Nodes --------------------------------------------------------------------------------------

const char *const unnormalized = "the rotation is no unit quaternion and is normalized";

// True if a rotation is longer or shorter than by rounding.
bool is_no_unit(const std::vector<double> &rotation)
{
    double squares = 0;
    for (const double value : rotation) {
        squares += value * value;
    }
    return !rotation.empty() && std::fabs(squares - 1) > 2e-3;
}

// Copies numbers; if the file has none, `row` keeps its own.
template <std::size_t N>
void take(const std::vector<double> &numbers, double (&row)[N])
{
    std::copy(numbers.begin(), numbers.end(), row);
}

void place_instances(const json &source, Arrays &arrays, glint_document_node &row)
{
    const json *instancing = extension_of(source, Place(), "EXT_mesh_gpu_instancing");
    const json *attributes = instancing == nullptr ? nullptr : member(*instancing, "attributes");
    std::size_t i = 0;
    for (const char *key : {"TRANSLATION", "ROTATION", "SCALE"}) {
        const json *accessor = attributes == nullptr ? nullptr : member(*attributes, key);
        row.instances[i++] =
            accessor == nullptr
                ? -1
                : arrays.of(static_cast<std::ptrdiff_t>(accessor->get<std::size_t>()));
    }
}

void write_nodes(const json &root, const Model &model, Arrays &arrays, Writer &writer)
{
    for (std::size_t i = 0; i < model.nodes.size(); i++) {
        const tinygltf::Node &node = model.nodes[i];
        const json &source = objects_of(root, "nodes")[i];
        glint_document_node row = {};
        row.name = writer.text(node.name);
        row.parent = model.parents[i];
        row.children = writer.add_run(writer.node_lists, node.children);
        row.mesh = node.mesh;
        row.camera = node.camera;
        row.skin = node.skin;
        row.light = model.light_of[i];
        row.has_matrix = node.matrix.empty() ? 0 : 1;
        row.is_hidden = model.hidden_nodes.count(i) > 0 ? 1 : 0;
        take({0, 0, 0, 1}, row.rotation);
        take({1, 1, 1}, row.scale);
        take(node.matrix, row.matrix);
        take(node.translation, row.translation);
        take(node.rotation, row.rotation);
        take(node.scale, row.scale);
        row.weights = writer.add_run(writer.weights, node.weights);
        place_instances(source, arrays, row);
        std::vector<Note> notes;
        if (is_no_unit(node.rotation)) {
            notes.push_back({"", unnormalized});
        }
        add_all(notes, survey_extensions(source, Holder::node));
        if (const auto own = model.node_notes.find(i); own != model.node_notes.end()) {
            add_all(notes, own->second);
        }
        row.notes = writer.add_notes(notes);
        writer.nodes.push_back(row);
    }
}

void write_scenes(const json &root, const Model &model, Writer &writer)
{
    for (std::size_t i = 0; i < model.scenes.size(); i++) {
        std::vector<Note> notes;
        add_all(notes, survey_extensions(objects_of(root, "scenes")[i], Holder::scene));
        glint_document_scene row = {};
        row.name = writer.text(model.scenes[i].name);
        row.roots = writer.add_run(writer.node_lists, model.scenes[i].nodes);
        row.notes = writer.add_notes(notes);
        writer.scenes.push_back(row);
    }
}

// ---- Meshes -------------------------------------------------------------------------------------

glint_run write_targets(const tinygltf::Primitive &source, Arrays &arrays, Writer &writer,
                        std::vector<Note> &notes)
{
    std::vector<glint_document_target> rows;
    for (const auto &target : source.targets) {
        glint_document_target row = {-1, -1};
        for (const auto &moved : target) {
            const std::string &name = moved.first;
            const bool is_read = std::any_of(morph_rows.begin(), morph_rows.end(),
                                             [&](const MorphRow &one) { return name == one.name; });
            if (!is_read && name != "TANGENT") { // tangents are computed anew
                notes.push_back({"", "a morph target moves " + name + ", which is left out"});
            } else if (is_read && source.attributes.count(name) == 0) {
                notes.push_back({"", "a morph target moves " + name +
                                         ", which the primitive has not, and is left out"});
            } else if (is_read) {
                (name == "POSITION" ? row.positions : row.normals) = arrays.of(moved.second);
            }
        }
        rows.push_back(row);
    }
    return writer.add_run(writer.targets, rows);
}

glint_run write_influences(const tinygltf::Primitive &source, Arrays &arrays, Writer &writer)
{
    std::vector<glint_document_influence> rows;
    for (std::size_t set = 0;; set++) {
        const std::int32_t joints = arrays.of(source.attributes, "JOINTS_" + std::to_string(set));
        const std::int32_t weights = arrays.of(source.attributes, "WEIGHTS_" + std::to_string(set));
        if (joints < 0 || weights < 0) {
            return writer.add_run(writer.influences, rows);
        }
        rows.push_back({joints, weights});
    }
}

void write_arrays(const tinygltf::Primitive &source, Arrays &arrays, Writer &writer,
                  std::vector<Note> &notes, glint_document_primitive &row)
{
    row.positions = arrays.of(source.attributes, "POSITION");
    row.normals = arrays.of(source.attributes, "NORMAL");
    row.tangents = arrays.of(source.attributes, "TANGENT");
    row.colors = arrays.of(source.attributes, "COLOR_0");
    row.texcoords[0] = arrays.of(source.attributes, "TEXCOORD_0");
    row.texcoords[1] = arrays.of(source.attributes, "TEXCOORD_1");
    row.indices = arrays.of(source.indices);
    row.targets = write_targets(source, arrays, writer, notes);
    row.influences = write_influences(source, arrays, writer);
}

using PrimitiveId = std::pair<std::size_t, std::size_t>; // mesh, and number in it

// Returns the primitive's materials of variants; NULL: it has none.
const MappedPrimitive *mapping_of(const Model &model, const PrimitiveId &which)
{
    const auto found = std::lower_bound(model.mapped.begin(), model.mapped.end(), which,
                                        [](const MappedPrimitive &one, auto key) {
                                            return std::make_pair(one.mesh, one.number) < key;
                                        });
    const bool is_there =
        found != model.mapped.end() && std::make_pair(found->mesh, found->number) == which;
    return is_there ? &*found : nullptr;
}

glint_document_primitive write_primitive(const json &source, const Model &model,
                                         const PrimitiveId &which, Arrays &arrays, Writer &writer)
{
    const tinygltf::Primitive &primitive = model.meshes[which.first].primitives[which.second];
    glint_document_primitive row = {};
    row.mode = primitive.mode;
    row.material = primitive.material;
    row.positions = row.normals = row.tangents = row.colors = row.indices = -1;
    row.texcoords[0] = row.texcoords[1] = -1;
    std::vector<Note> notes;
    if (primitive.mode >= TINYGLTF_MODE_TRIANGLES) {
        write_arrays(primitive, arrays, writer, notes, row);
    }
    add_all(notes, survey_extensions(source, Holder::primitive));
    if (const auto own = model.notes.find(which); own != model.notes.end()) {
        add_all(notes, own->second);
    }
    row.notes = writer.add_notes(notes);
    if (const MappedPrimitive *mapped = mapping_of(model, which)) {
        row.mapping_fault = writer.text(mapped->fault);
        std::vector<glint_document_mapping> rows;
        for (const auto &[variant, material] : mapped->materials) {
            rows.push_back({static_cast<std::int32_t>(variant), material});
        }
        row.mappings = writer.add_run(writer.mappings, rows);
    }
    return row;
}

void write_meshes(const json &root, const Model &model, Arrays &arrays, Writer &writer)
{
    for (std::size_t m = 0; m < model.meshes.size(); m++) {
        const json &sources = objects_of(root, "meshes")[m]["primitives"];
        std::vector<glint_document_primitive> rows;
        for (std::size_t p = 0; p < model.meshes[m].primitives.size(); p++) {
            rows.push_back(write_primitive(sources[p], model, {m, p}, arrays, writer));
        }
        glint_document_mesh row = {};
        row.primitives = writer.add_run(writer.primitives, rows);
        row.weights = writer.add_run(writer.weights, model.meshes[m].weights);
        row.target_count = static_cast<std::uint32_t>(model.target_counts[m]);
        writer.meshes.push_back(row);
    }
}

// ---- The rest -----------------------------------------------------------------------------------

void write_cameras(const Model &model, Writer &writer)
{
    for (std::size_t i = 0; i < model.cameras.size(); i++) {
        const tinygltf::Camera &source = model.cameras[i];
        glint_document_camera row = {};
        row.name = writer.text(source.name);
        row.is_orthographic = source.type == "orthographic" ? 1 : 0;
        row.size = row.is_orthographic != 0 ? std::fabs(source.orthographic.ymag)
                                            : source.perspective.yfov;
        if (row.is_orthographic != 0 && source.orthographic.ymag < 0) {
            row.notes = writer.add_notes(
                {{(Place() / "cameras")[i].text(), "a negative ymag is taken as positive"}});
        }
        writer.cameras.push_back(row);
    }
}

void write_lights(const Model &model, Writer &writer)
{
    for (std::size_t i = 0; i < model.lights.size(); i++) {
        const tinygltf::Light &source = model.lights[i];
        glint_document_light row = {};
        row.name = writer.text(source.name);
        row.kind = source.type.empty()      ? -1
                   : source.type == "spot"  ? GLINT_PUNCTUAL_SPOT
                   : source.type == "point" ? GLINT_PUNCTUAL_POINT
                                            : GLINT_PUNCTUAL_DIRECTIONAL;
        for (std::size_t k = 0; row.kind >= 0 && k < 3; k++) {
            row.color[k] = std::min(source.color[k] * source.intensity, DBL_MAX);
        }
        row.range = source.range;
        row.inner_angle = source.spot.innerConeAngle;
        row.outer_angle = source.spot.outerConeAngle;
        const std::string where = (Place() / "lights")[i].text() +
                                  (source.name.empty() ? "" : " " + in_quotes(source.name));
        std::vector<Note> notes;
        for (const std::string &text : model.light_notes[i]) {
            notes.push_back({where, text});
        }
        row.notes = writer.add_notes(notes);
        writer.lights.push_back(row);
    }
}

void write_skins(const Model &model, Arrays &arrays, Writer &writer)
{
    for (const tinygltf::Skin &skin : model.skins) {
        writer.skins.push_back(
            {writer.add_run(writer.joints, skin.joints), arrays.of(skin.inverseBindMatrices)});
    }
}

void write_usages(const json &root, Writer &writer)
{
    const json &used = optional_array(root, Place(), "extensionsUsed");
    for (std::size_t i = 0; i < used.size(); i++) {
        const std::string name = text_of(used[i], (Place() / "extensionsUsed")[i]);
        writer.usages.push_back({writer.text(name), treatment_of(name)});
    }
}

} // namespace

void compose(const SceneFile &input, const Model &model, Writer &writer)
{
    const json &root = input.root;
    Arrays arrays(model, writer);
    write_nodes(root, model, arrays, writer);
    write_scenes(root, model, writer);
    write_meshes(root, model, arrays, writer);
    write_materials(root, writer);
    write_images(root, model, writer);
    write_cameras(model, writer);
    write_lights(model, writer);
    write_skins(model, arrays, writer);
    write_animations(root, model, arrays, writer);
    for (const std::string &name : model.variants) {
        writer.variants.push_back({writer.text(name)});
    }
    write_usages(root, writer);
    writer.finish(model.defaultScene);
}

} // namespace glint
