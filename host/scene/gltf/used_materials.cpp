// Reads the materials of drawn primitives. See used_materials.hpp.
#include "scene/gltf/used_materials.hpp"

namespace glint
{

namespace
{

// True if some primitive names no material.
bool uses_default_material(const Model &model)
{
    for (const tinygltf::Mesh &mesh : model.meshes) {
        for (const tinygltf::Primitive &primitive : mesh.primitives) {
            if (primitive.material < 0) {
                return true;
            }
        }
    }
    return false;
}

// Finds the overrides' materials among all materials of the file, because the materials in use may
// change over time.
void resolve_overrides(Load &load)
{
    const json &root = load.document.root;
    const std::size_t count = objects_of(root, "materials").size();
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; i++) {
        names.push_back(material_name(root, static_cast<std::ptrdiff_t>(i)));
    }
    std::vector<glint_material> materials;
    std::vector<Note> unused; // the notes of used materials are taken later
    for (std::size_t i = 0; i < count; i++) {
        materials.push_back(read_factors(root, static_cast<std::ptrdiff_t>(i), unused));
        materials.back().name = names[i].empty() ? nullptr : names[i].data();
    }
    if (uses_default_material(load.model)) {
        materials.push_back(read_factors(root, -1, unused));
    }
    glint_error error = {};
    if (glint_material_overrides_resolve(&load.overrides, materials.data(), materials.size(),
                                         &error) != GLINT_OK) {
        throw refusal(error.message);
    }
}

// Reads the materials of drawn primitives; notes which have vertex colours.
void read_materials(Load &load)
{
    for (const Visit &visit : load.visits) {
        const int mesh = load.model.nodes[visit.node].mesh;
        if (mesh < 0) {
            continue;
        }
        const auto m = static_cast<std::size_t>(mesh);
        for (std::size_t p = load.primitives.first[m]; p < load.primitives.first[m + 1]; p++) {
            const glint_primitive &primitive = load.primitives.all[p];
            if (primitive.triangles == 0) {
                continue;
            }
            auto found = load.materials.find(primitive.material);
            if (found == load.materials.end()) {
                const UsedMaterial read = read_material(load.document.root, primitive.material);
                found = load.materials.emplace(primitive.material, read).first;
            }
            glint_material &material = found->second.material;
            material.has_vertex_colors =
                material.has_vertex_colors || primitive.color_components > 0;
        }
    }
}

void override_material(const Load &load, std::ptrdiff_t index, UsedMaterial &used)
{
    std::string name = material_name(load.document.root, index);
    used.material.name = name.empty() ? nullptr : name.data();
    used.is_replaced = glint_material_overrides_apply(&load.overrides, &used.material);
    used.material.name = nullptr;
}

} // namespace

void read_used_materials(const glint_scene_options &options, Load &load)
{
    if (options.overrides != nullptr) {
        load.overrides = *options.overrides;
        resolve_overrides(load);
    }
    read_materials(load);
    for (auto &one : load.materials) {
        override_material(load, one.first, one.second);
        note_images(one.second, load.images);
    }
    load.images.read(load.document, load.model, options.texture_size);
    for (auto &one : load.materials) {
        settle_material(load.images, one.second, load.tally);
    }
}

} // namespace glint
