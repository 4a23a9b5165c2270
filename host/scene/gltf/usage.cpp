// Lists the glTF features that a file uses. See usage.hpp.
#include "scene/gltf/usage.hpp"

#include "base/memory.h"
#include "scene/gltf/extensions.hpp"

#include <algorithm>
#include <new>

namespace glint
{

namespace
{

// Usages in the order of first use. If a name occurs twice, the worse treatment counts.
class Usages
{
  public:
    void add(const std::string &name, glint_treatment treatment)
    {
        auto found = std::find_if(all_.begin(), all_.end(),
                                  [&](const auto &one) { return one.first == name; });
        if (found == all_.end()) {
            all_.emplace_back(name, treatment);
        } else {
            found->second = std::max(found->second, treatment);
        }
    }

    void move_to(glint_scene &scene) const
    {
        scene.usages = static_cast<glint_usage *>(glint_allocate(all_.size(), sizeof(glint_usage)));
        if (scene.usages == nullptr) {
            throw std::bad_alloc();
        }
        for (const auto &one : all_) {
            scene.usages[scene.usage_count++] = {copy_text(one.first), one.second};
        }
    }

  private:
    std::vector<std::pair<std::string, glint_treatment>> all_;
};

void add_material(const glint_material &material, Usages &usages)
{
    const glint_lobes lobes = glint_material_lobes(&material);
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        if (material.textures[slot].image != 0) {
            const auto which = static_cast<glint_texture_slot>(slot);
            usages.add(std::string("texture: ") + glint_texture_slot_name(which), GLINT_RENDERED);
        }
    }
    if (material.roughness > 0 && (lobes.metal || lobes.glass || lobes.paint)) {
        usages.add("roughness", GLINT_RENDERED);
    }
    if (lobes.masked || lobes.covers) {
        usages.add(lobes.masked ? "alphaMode MASK" : "alphaMode BLEND", GLINT_RENDERED);
    }
    if (material.has_vertex_colors) {
        usages.add("COLOR_0", GLINT_RENDERED);
    }
}

// Counts thickness textures as approximated: light travels through the solid itself, and the
// texture is only an estimate of that distance.
void add_thickness(const Load &load, std::ptrdiff_t index, const UsedMaterial &used, Usages &usages)
{
    if (index < 0 || used.is_replaced || !(used.material.thickness > 0)) {
        return;
    }
    const auto &materials = objects_of(load.document.root, "materials");
    const json *volume =
        extension_of(materials[static_cast<std::size_t>(index)], Place(), "KHR_materials_volume");
    if (volume != nullptr && member(*volume, "thicknessTexture") != nullptr) {
        usages.add("thicknessTexture", GLINT_APPROXIMATED);
    }
}

void add_meshes(const Load &load, Usages &usages)
{
    for (const Visit &visit : load.visits) {
        const tinygltf::Node &node = load.model.nodes[visit.node];
        if (node.mesh < 0) {
            continue;
        }
        const auto m = static_cast<std::size_t>(node.mesh);
        for (std::size_t p = load.primitives.first[m]; p < load.primitives.first[m + 1]; p++) {
            const glint_primitive &primitive = load.primitives.all[p];
            if (primitive.target_count > 0) {
                usages.add("morph targets", GLINT_RENDERED);
            }
            if (node.skin >= 0 && primitive.influences.count > 0) {
                usages.add("skins", GLINT_RENDERED);
            }
        }
    }
}

} // namespace

void list_usages(const Load &load, glint_scene &scene)
{
    Usages usages;
    const json *extensions = member(load.document.root, "extensionsUsed");
    for (std::size_t i = 0; extensions != nullptr && i < extensions->size(); i++) {
        const std::string name = text_of((*extensions)[i], Place());
        usages.add(name, treatment_of(name));
    }
    for (std::size_t i = 0; i < scene.material_count; i++) {
        add_material(scene.materials[i], usages);
    }
    for (const auto &one : load.materials) {
        for (const MissingTexture &missing : one.second.missing) {
            usages.add(missing.key, GLINT_IGNORED);
        }
        add_thickness(load, one.first, one.second, usages);
    }
    add_meshes(load, usages);
    if (scene.skipped_points + scene.skipped_lines > 0) {
        usages.add("points and lines", GLINT_IGNORED);
    }
    if (load.moves_triangles || load.moves_cameras || load.moves_lights) {
        usages.add("animation", GLINT_RENDERED);
    }
    usages.move_to(scene);
}

} // namespace glint
