// Reads materials and their textures. Warns of what is left out. See material.hpp.
#include "decoder/material.hpp"

#include "decoder/extensions.hpp"
#include "decoder/factors.hpp"

#include <cstring>

namespace glint
{

namespace
{

// A texture that glint cannot show, and the reason.
struct MissingTexture {
    glint_texture_slot slot;
    std::string key;
    Note fault;
};

struct ReadMaterial {
    glint_material material = {};
    std::vector<MissingTexture> missing;
    std::vector<Note> notes; // of values that are taken otherwise
};

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
                  ReadMaterial &read)
{
    try {
        const json &info = object_at(holder, place, slot.key);
        read.material.textures[slot.slot] =
            read_texture_info(root, info, place / slot.key, read.notes);
    } catch (const refusal &fault) {
        read.missing.push_back({slot.slot, slot.key, {fault.where(), fault.cause()}});
    }
}

void survey_extras(const json &material, std::vector<Note> &notes)
{
    const json *extras = member(material, "extras");
    const json *ours =
        extras != nullptr && extras->is_object() ? member(*extras, "glint") : nullptr;
    if (ours == nullptr) {
        return;
    }
    for (auto it = ours->begin(); it != ours->end(); ++it) {
        if (it.key() != "mirror" && it.key() != "priority") {
            notes.push_back({"", "extras.glint." + in_quotes(it.key()) +
                                     " is unknown and ignored (\"mirror\" and \"priority\" are "
                                     "what there is)"});
        }
    }
}

// Light travels through the solid itself; the texture is only an estimate of that distance.
bool has_thickness_texture(const json &material, const Place &place)
{
    const json *volume = extension_of(material, place, "KHR_materials_volume");
    return volume != nullptr && member(*volume, "thicknessTexture") != nullptr;
}

glint_document_material read_material(const json &root, std::size_t index, Writer &writer)
{
    const json &material = objects_of(root, "materials")[index];
    const Place place = (Place() / "materials")[index];
    ReadMaterial read;
    read.material = read_factors_at(material, place, read.notes);
    glint_document_material row = {};
    for (const TextureSlot &slot : texture_slots()) {
        const json *holder = holder_of(material, place, slot);
        if (holder != nullptr && member(*holder, slot.key) != nullptr) {
            take_texture(root, *holder, place_of(place, slot), slot, read);
            row.texture_keys[slot.slot] = writer.text(slot.key);
        }
    }
    for (const std::string &text : survey_extensions(material, Holder::material)) {
        read.notes.push_back({"", text});
    }
    survey_extras(material, read.notes);
    row.name = writer.text(name_of(material));
    row.has_thickness_texture = has_thickness_texture(material, place) ? 1 : 0;
    row.material = read.material;
    row.notes = writer.add_notes(read.notes);
    std::vector<glint_document_missing> missing;
    for (const MissingTexture &one : read.missing) {
        missing.push_back({one.slot, writer.text(one.key), writer.text(one.fault.where),
                           writer.text(one.fault.text)});
    }
    row.missing = writer.add_run(writer.missing, missing);
    return row;
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

void write_materials(const json &root, Writer &writer)
{
    const std::size_t count = objects_of(root, "materials").size();
    for (std::size_t i = 0; i < count; i++) {
        writer.materials.push_back(read_material(root, i, writer));
    }
}

} // namespace glint
