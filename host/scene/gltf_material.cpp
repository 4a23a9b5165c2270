// Materials: checked, read, and surveyed for what is not modelled. Checking and reading are one
// pass, so that no value can be read that was not checked. See gltf_material.hpp.
#include "scene/gltf_material.hpp"

#include "scene/gltf_extensions.hpp"

#include <array>
#include <cfloat>
#include <cmath>
#include <cstring>

namespace glint
{

namespace
{

// A texture slot: what stands instead of what the texture says.
struct Slot {
    const char *holder; // NULL: the material itself, "KHR_…": the extension
    const char *key;
    const char *instead;
};

const std::array<Slot, 8> slots = {{
    {"pbrMetallicRoughness", "baseColorTexture", "baseColorFactor alone is used"},
    {"pbrMetallicRoughness", "metallicRoughnessTexture",
     "metallicFactor and roughnessFactor alone are used"},
    {nullptr, "normalTexture", "the mesh's own normals are used"},
    {nullptr, "occlusionTexture", "nothing is darkened"},
    {nullptr, "emissiveTexture", "emissiveFactor alone is used"},
    {"KHR_materials_transmission", "transmissionTexture", "transmissionFactor alone is used"},
    {"KHR_materials_volume", "thicknessTexture", "thicknessFactor alone is used"},
    {"KHR_materials_ior", "iorTexture", "ior alone is used"},
}};

float factor(const json &object, const Place &place, const char *key, double fallback)
{
    const json *found = member(object, key);
    return found == nullptr ? static_cast<float>(fallback)
                            : static_cast<float>(number_within(*found, place / key, 0, 1));
}

// A number from `low` up, that a float can hold.
float factor_from(const json &object, const Place &place, const char *key, double low,
                  double fallback)
{
    const json *found = member(object, key);
    if (found == nullptr) {
        return static_cast<float>(fallback);
    }
    double value = number_of(*found, place / key);
    if (!(value >= low && value <= FLT_MAX)) {
        refuse(place / key, shown(value) + " is out of range (give " + shown(low) + " or more)");
    }
    return static_cast<float>(value);
}

// The first three of `count` numbers in [0, 1].
void color(const json &object, const Place &object_place, const char *key, std::size_t count,
           float *result)
{
    const json *found = member(object, key);
    if (found == nullptr) {
        return;
    }
    Place place = object_place / key;
    if (!found->is_array() || found->size() != count) {
        refuse(place, "not an array of " + std::to_string(count) + " numbers");
    }
    for (std::size_t i = 0; i < count; i++) {
        double value = number_within((*found)[i], place[i], 0, 1);
        if (i < 3) {
            result[i] = static_cast<float>(value);
        }
    }
}

const json *extension(const json &material, const Place &place, const char *name)
{
    const json *extensions = optional_object(material, place, "extensions");
    return extensions == nullptr ? nullptr
                                 : optional_object(*extensions, place / "extensions", name);
}

// Where the slot's holder stands in the material; NULL where it is missing.
const json *holder_of(const json &material, const Place &place, const Slot &slot)
{
    if (slot.holder == nullptr) {
        return &material;
    }
    return std::strncmp(slot.holder, "KHR_", 4) == 0
               ? extension(material, place, slot.holder)
               : optional_object(material, place, slot.holder);
}

void check_textures(const json &root, const json &material, const Place &place)
{
    std::size_t textures = objects_of(root, "textures").size();
    for (const Slot &slot : slots) {
        const json *holder = holder_of(material, place, slot);
        if (holder == nullptr || member(*holder, slot.key) == nullptr) {
            continue;
        }
        Place at = place;
        if (slot.holder != nullptr) {
            bool extends = std::strncmp(slot.holder, "KHR_", 4) == 0;
            at = (extends ? place / "extensions" : place) / slot.holder;
        }
        const json &info = object_at(*holder, at, slot.key);
        if (member(info, "index") == nullptr) {
            refuse(at / slot.key / "index", "missing (glTF 2.0 requires it)");
        }
        index_of(info["index"], at / slot.key / "index", textures, "texture");
    }
}

float read_ior(const json &object, const Place &place)
{
    const json *found = member(object, "ior");
    if (found == nullptr) {
        return 1.5F;
    }
    double ior = number_of(*found, place / "ior");
    if (ior == 0) {
        refuse(place / "ior", "0, which means an infinite index and reflects everything, is not "
                              "modelled (make the material metallic)");
    }
    if (!(ior >= 1 && ior <= FLT_MAX)) {
        refuse(place / "ior", shown(ior) + " is no index of refraction (1 or more; glass has 1.5)");
    }
    return static_cast<float>(ior);
}

void read_volume(const json &object, const Place &place, glint_material &result)
{
    result.thickness = factor_from(object, place, "thicknessFactor", 0, 0);
    color(object, place, "attenuationColor", 3, result.attenuation_color);
    const json *distance = member(object, "attenuationDistance");
    if (distance != nullptr) {
        double value = number_of(*distance, place / "attenuationDistance");
        // Beyond what a float holds nothing is absorbed on any path.
        result.attenuation_distance = value > FLT_MAX ? INFINITY : static_cast<float>(value);
        if (!(result.attenuation_distance > 0)) {
            refuse(place / "attenuationDistance",
                   shown(value) + " is no distance (metres, more than 0; leave it out for clear "
                                  "glass)");
        }
    }
}

void read_extensions(const json &material, const Place &place, glint_material &result)
{
    Place at = place / "extensions";
    if (const json *found = extension(material, place, "KHR_materials_transmission")) {
        result.transmission =
            factor(*found, at / "KHR_materials_transmission", "transmissionFactor", 0);
    }
    if (const json *found = extension(material, place, "KHR_materials_ior")) {
        result.ior = read_ior(*found, at / "KHR_materials_ior");
    }
    if (const json *found = extension(material, place, "KHR_materials_volume")) {
        read_volume(*found, at / "KHR_materials_volume", result);
    }
    if (const json *found = extension(material, place, "KHR_materials_emissive_strength")) {
        float strength =
            factor_from(*found, at / "KHR_materials_emissive_strength", "emissiveStrength", 0, 1);
        for (float &component : result.emission) {
            component *= strength;
        }
    }
    result.unlit = extension(material, place, "KHR_materials_unlit") != nullptr;
}

// The lecture's blend: extras {"glint": {"mirror": m}}. Other programs' extras can be anything.
void read_extras(const json &material, const Place &place, glint_material &result)
{
    const json *extras = member(material, "extras");
    const json *ours =
        extras != nullptr && extras->is_object() ? member(*extras, "glint") : nullptr;
    if (ours == nullptr) {
        return;
    }
    Place at = place / "extras" / "glint";
    const json &object = object_at(*extras, place / "extras", "glint");
    const json *mirror = member(object, "mirror");
    if (mirror != nullptr) {
        result.mirror = static_cast<float>(number_within(*mirror, at / "mirror", 0, 1));
    }
}

glint_material read(const json &root, const json &material, const Place &place)
{
    glint_material result = read_material(root, -1);
    if (const json *metal = optional_object(material, place, "pbrMetallicRoughness")) {
        Place at = place / "pbrMetallicRoughness";
        color(*metal, at, "baseColorFactor", 4, result.base_color);
        result.metallic = factor(*metal, at, "metallicFactor", 1);
        result.roughness = factor(*metal, at, "roughnessFactor", 1);
    }
    color(material, place, "emissiveFactor", 3, result.emission);
    read_extensions(material, place, result);
    read_extras(material, place, result);
    return result;
}

const char *const rendered_smooth =
    "roughness above 0 on metal or glass is rendered smooth for now";

// materials[3] "gem"
std::string named(std::size_t index, const std::string &name)
{
    return (Place() / "materials")[index].text() + (name.empty() ? "" : " " + in_quotes(name));
}

bool shows_roughness(const glint_material &material)
{
    const glint_lobes lobes = glint_material_lobes(&material);
    return material.roughness > 0 && (lobes.metal || lobes.glass);
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
        if (it.key() != "mirror") {
            tally.add("extras.glint." + in_quotes(it.key()) +
                          " is unknown and ignored (\"mirror\" is what there is)",
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
        optional_text(material, place, "name");
        std::string alpha = optional_text(material, place, "alphaMode");
        if (!alpha.empty() && alpha != "OPAQUE" && alpha != "MASK" && alpha != "BLEND") {
            refuse(place / "alphaMode", in_quotes(alpha) + " is none (OPAQUE, MASK or BLEND)");
        }
        factor_from(material, place, "alphaCutoff", 0, 0.5);
        optional_boolean(material, place, "doubleSided", false);
        read(root, material, place);
        check_textures(root, material, place);
    }
}

glint_material read_material(const json &root, std::ptrdiff_t index)
{
    if (index >= 0) {
        auto i = static_cast<std::size_t>(index);
        glint_material result =
            read(root, objects_of(root, "materials")[i], (Place() / "materials")[i]);
        result.index = static_cast<int>(index);
        return result;
    }
    glint_material result = {};
    result.index = static_cast<int>(objects_of(root, "materials").size());
    for (int i = 0; i < 3; i++) {
        result.base_color[i] = 1;
        result.attenuation_color[i] = 1;
    }
    result.metallic = 1;
    result.roughness = 1;
    result.ior = 1.5F;
    result.attenuation_distance = INFINITY;
    result.mirror = -1;
    return result;
}

std::string material_name(const json &root, std::ptrdiff_t index)
{
    return index < 0 ? ""
                     : optional_text(objects_of(root, "materials")[static_cast<std::size_t>(index)],
                                     Place(), "name");
}

void survey_material(const json &root, std::ptrdiff_t index, Tally &tally)
{
    if (index < 0) {
        tally.add(rendered_smooth, "the default material");
        return;
    }
    auto i = static_cast<std::size_t>(index);
    Place place = (Place() / "materials")[i];
    const json &material = objects_of(root, "materials")[i];
    std::string where = named(i, material_name(root, index));
    for (const Slot &slot : slots) {
        const json *holder = holder_of(material, place, slot);
        if (holder != nullptr && member(*holder, slot.key) != nullptr) {
            tally.add(std::string(slot.key) + ": textures are not modelled yet, " + slot.instead,
                      where);
        }
    }
    if (shows_roughness(read_material(root, index))) {
        tally.add(rendered_smooth, where);
    }
    std::string alpha = optional_text(material, place, "alphaMode");
    if (alpha == "MASK" || alpha == "BLEND") {
        tally.add("alphaMode " + alpha + " is not modelled, the surface is rendered opaque", where);
    }
    survey_extensions(material, Holder::material, where, tally);
    survey_extras(material, where, tally);
}

void survey_override(const glint_material &material, Tally &tally)
{
    if (shows_roughness(material)) {
        tally.add(rendered_smooth, named(static_cast<std::size_t>(material.index),
                                         material.name != nullptr ? material.name : ""));
    }
}

} // namespace glint
