// Reads materials and their textures. Warns of what is left out. See material.hpp.
#include "scene/gltf/material.hpp"

#include "scene/gltf/extensions.hpp"
#include "scene/gltf/factors.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace glint
{

namespace
{

bool is_extension(const char *holder)
{
    return std::strncmp(holder, "KHR_", 4) == 0;
}

// Returns the object that holds the slot in the material; NULL if it is missing or does not count.
const json *holder_of(const json &material, const Place &place, const TextureSlot &slot)
{
    if (slot.holder != nullptr && std::strcmp(slot.holder, "pbrMetallicRoughness") == 0 &&
        extension_of(material, place, specular_glossiness) != nullptr) {
        return nullptr;
    }
    if (slot.holder == nullptr) {
        return &material;
    }
    return is_extension(slot.holder) ? extension_of(material, place, slot.holder)
                                     : optional_object(material, place, slot.holder);
}

Place place_of(const Place &place, const TextureSlot &slot)
{
    return slot.holder == nullptr      ? place
           : is_extension(slot.holder) ? place / "extensions" / slot.holder
                                       : place / slot.holder;
}

// Copies a textureInfo to the material, with the image's place in the file.
void take_texture(const json &root, const json &holder, const Place &place, const TextureSlot &slot,
                  UsedMaterial &read)
{
    try {
        const json &info = object_at(holder, place, slot.key);
        read.material.textures[slot.slot] =
            read_texture_info(root, info, place / slot.key, read.notes);
    } catch (const refusal &fault) {
        read.missing.push_back({slot.slot, slot.key, {fault.where(), fault.cause()}});
    }
}

bool is_black(const float color[3])
{
    return !(color[0] > 0 || color[1] > 0 || color[2] > 0);
}

// False if the picture does not show the texture, because what it multiplies is 0.
bool is_seen(glint_texture_slot slot, const glint_material &m)
{
    if (m.unlit) {
        return slot == GLINT_TEXTURE_BASE_COLOR;
    }
    switch (slot) {
    case GLINT_TEXTURE_EMISSION:
        return !is_black(m.emission);
    case GLINT_TEXTURE_TRANSMISSION:
        return m.transmission > 0;
    case GLINT_TEXTURE_CLEARCOAT:
    case GLINT_TEXTURE_CLEARCOAT_ROUGHNESS:
    case GLINT_TEXTURE_CLEARCOAT_NORMAL:
        return m.clearcoat > 0;
    case GLINT_TEXTURE_SHEEN_COLOR:
    case GLINT_TEXTURE_SHEEN_ROUGHNESS:
        return !is_black(m.sheen_color);
    case GLINT_TEXTURE_IRIDESCENCE:
    case GLINT_TEXTURE_IRIDESCENCE_THICKNESS:
        return m.iridescence > 0;
    case GLINT_TEXTURE_ANISOTROPY:
        return m.anisotropy > 0;
    case GLINT_TEXTURE_DIFFUSE_TRANSMISSION:
    case GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR:
        return m.diffuse_transmission > 0;
    default:
        return true;
    }
}

// For example: materials[3] "gem"
std::string where_is(const json &root, std::ptrdiff_t index)
{
    if (index < 0) {
        return "the default material";
    }
    const std::string name = material_name(root, index);
    return (Place() / "materials")[static_cast<std::size_t>(index)].text() +
           (name.empty() ? "" : " " + in_quotes(name));
}

void survey_extras(const json &material, const std::string &where, Tally &tally)
{
    const json *extras = member(material, "extras");
    const json *ours =
        extras != nullptr && extras->is_object() ? member(*extras, "glint") : nullptr;
    if (ours == nullptr) {
        return;
    }
    for (auto it = ours->begin(); it != ours->end(); ++it) {
        if (it.key() != "mirror" && it.key() != "priority") {
            tally.add("extras.glint." + in_quotes(it.key()) +
                          " is unknown and ignored (\"mirror\" and \"priority\" are what there is)",
                      where);
        }
    }
}

} // namespace

void check_materials(const json &root)
{
    const json &materials = objects_of(root, "materials");
    for (std::size_t i = 0; i < materials.size(); i++) {
        Place place = (Place() / "materials")[i];
        const json &material = materials[i];
        optional_boolean(material, place, "doubleSided", false);
        std::vector<Note> unused; // used materials are read again
        read_factors_at(material, place, unused);
    }
}

glint_material read_factors(const json &root, std::ptrdiff_t index, std::vector<Note> &notes)
{
    const json &materials = objects_of(root, "materials");
    const auto i = static_cast<std::size_t>(index);
    glint_material result = index < 0
                                ? glint_material_default
                                : read_factors_at(materials[i], (Place() / "materials")[i], notes);
    result.index = static_cast<int>(index < 0 ? materials.size() : i);
    return result;
}

UsedMaterial read_material(const json &root, std::ptrdiff_t index)
{
    UsedMaterial read;
    read.material = read_factors(root, index, read.notes);
    if (index < 0) {
        return read;
    }
    const auto i = static_cast<std::size_t>(index);
    const Place place = (Place() / "materials")[i];
    const json &material = objects_of(root, "materials")[i];
    for (const TextureSlot &slot : texture_slots()) {
        const json *holder = holder_of(material, place, slot);
        if (holder != nullptr && member(*holder, slot.key) != nullptr) {
            take_texture(root, *holder, place_of(place, slot), slot, read);
        }
    }
    return read;
}

void note_images(UsedMaterial &used, Images &images)
{
    std::array<bool, GLINT_TEXTURE_SLOTS> is_noted{};
    for (const TextureSlot &slot : texture_slots()) {
        glint_texture_use &use = used.material.textures[slot.slot];
        if (use.image != 0 && !is_noted[slot.slot]) {
            const bool is_coverage = slot.slot == GLINT_TEXTURE_BASE_COLOR &&
                                     used.material.alpha_mode != GLINT_ALPHA_OPAQUE;
            use.image = images.number_of({use.image - 1, slot.is_color, is_coverage});
            is_noted[slot.slot] = true;
        }
    }
}

void settle_material(const Images &images, UsedMaterial &used, Tally &tally)
{
    const Tally::About about(tally, used.material.index);
    for (const TextureSlot &slot : texture_slots()) {
        glint_texture_use &use = used.material.textures[slot.slot];
        if (use.image != 0 && !images.fault(use.image).text.empty()) {
            used.missing.push_back({slot.slot, slot.key, images.fault(use.image)});
            use = {};
        }
    }
    for (const MissingTexture &missing : used.missing) {
        if (used.is_replaced && missing.slot != GLINT_TEXTURE_BASE_COLOR) {
            continue; // a preset keeps no other texture
        }
        if (!is_seen(missing.slot, used.material)) {
            continue;
        }
        if (missing.slot == GLINT_TEXTURE_EMISSION) {
            // The factor alone would make the whole surface shine, where most maps are black but
            // for a few lamps.
            std::fill(used.material.emission, used.material.emission + 3, 0.0F);
        }
        tally.add_once(missing.fault.text + "; the maps that need it are left out",
                       missing.fault.where);
    }
}

std::string material_name(const json &root, std::ptrdiff_t index)
{
    return index < 0 ? "" : name_of(objects_of(root, "materials")[static_cast<std::size_t>(index)]);
}

void survey_material(const json &root, std::ptrdiff_t index, const UsedMaterial &used,
                     bool loses_alpha, Tally &tally)
{
    const Tally::About about(tally, used.material.index);
    const std::string where = where_is(root, index);
    if (loses_alpha) {
        tally.add("alphaMode counts for nothing in glass with a volume: it is all there", where);
    }
    if (index >= 0 && !used.is_replaced) {
        for (const Note &note : used.notes) {
            tally.add_once(note.text, note.where.empty() ? where : note.where);
        }
        const json &material = objects_of(root, "materials")[static_cast<std::size_t>(index)];
        survey_extensions(material, Holder::material, where, tally);
        survey_extras(material, where, tally);
    }
}

} // namespace glint
