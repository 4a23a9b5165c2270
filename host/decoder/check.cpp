// Validates the top level of the raw JSON, where no other file does. See check.hpp.
#include "decoder/check.hpp"

#include "decoder/check_storage.hpp"
#include "decoder/extensions.hpp"
#include "decoder/material.hpp"
#include "decoder/variants.hpp"

namespace glint
{

namespace
{

// Checks a version: "2.0" has the major number 2. Another major number means another format.
void check_version(const json &asset, const Place &place, const char *key)
{
    const json *found = member(asset, key);
    // Some exporters write the number 2.
    const bool is_number = found != nullptr && found->is_number();
    std::string version =
        is_number ? shown(found->get<double>()) : optional_text(asset, place, key);
    if (!version.empty() && version != "2" && version.compare(0, 2, "2.") != 0) {
        refuse(place / key,
               in_quotes(version) + " is not supported (convert the file to glTF 2.0)");
    }
}

void check_asset(const json &root)
{
    const json *asset = member(root, "asset");
    if (asset == nullptr) {
        refuse(Place() / "asset", "missing (every glTF 2.0 file has one: is this another format?)");
    }
    Place place = Place() / "asset";
    const json &object = object_at(root, Place(), "asset");
    if (member(object, "version") == nullptr) {
        refuse(place / "version", "missing (it must say \"2.0\")");
    }
    check_version(object, place, "version");
    check_version(object, place, "minVersion");
}

void check_extensions(const json &root, Model &model)
{
    Place required = Place() / "extensionsRequired";
    const json &array = optional_array(root, Place(), "extensionsRequired");
    for (std::size_t i = 0; i < array.size(); i++) {
        std::string name = text_of(array[i], required[i]);
        if (!can_be_required(name)) {
            refuse(required[i], in_quotes(name) +
                                    " is required by the file and not supported (export "
                                    "the file without it)");
        }
        model.quantized = model.quantized || name == "KHR_mesh_quantization";
        model.requires_draco = model.requires_draco || name == "KHR_draco_mesh_compression";
    }
    const json &used = optional_array(root, Place(), "extensionsUsed");
    for (std::size_t i = 0; i < used.size(); i++) {
        std::string name = text_of(used[i], (Place() / "extensionsUsed")[i]);
        model.quantized = model.quantized || name == "KHR_mesh_quantization";
    }
}

} // namespace

void check_document(const SceneFile &input, Model &model)
{
    check_asset(input.root);
    // First of all, so that the other checks can rely on it.
    for (const char *key :
         {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
          "meshes", "nodes", "samplers", "scenes", "skins", "textures"}) {
        check_objects(input.root, key);
    }
    check_extensions(input.root, model);
    check_storage(input.root, model);
    check_materials(input.root);
    read_variants(input.root, model);
    check_meshes(input.root, model);
    check_zeros(model);
    check_graph(input.root, model);
}

} // namespace glint
