// Checks and reads materials in one pass, so that no unchecked value can be read. Warns of features
// that glint does not model. See gltf_material.hpp.
#include "scene/gltf_material.hpp"

#include "scene/gltf_extensions.hpp"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstring>

namespace glint
{

namespace
{

const char *const specular_glossiness = "KHR_materials_pbrSpecularGlossiness";

float factor(const json &object, const Place &place, const char *key, double fallback)
{
    const json *found = member(object, key);
    return found == nullptr ? static_cast<float>(fallback)
                            : static_cast<float>(number_within(*found, place / key, 0, 1));
}

// Reads a number of at least `low` that a float can hold.
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

// Reads `count` numbers in [0, 1].
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
        result[i] = static_cast<float>(number_within((*found)[i], place[i], 0, 1));
    }
}

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
void take_texture(const json &root, const json &info, const TextureSlot &slot, UsedMaterial &read)
{
    std::ptrdiff_t image = -1;
    glint_texture_use use = read_texture_info(root, info, &image);
    if (image < 0) {
        read.missing.push_back({slot.slot, slot.key,
                                "it names no image of a kind that is read (PNG, JPEG, WebP, DDS)"});
        return;
    }
    if (use.texcoord > 1) {
        read.missing.push_back(
            {slot.slot, slot.key,
             "TEXCOORD_" + std::to_string(use.texcoord) + " is not read (use set 0 or 1)"});
        return;
    }
    use.image = static_cast<std::uint32_t>(image) + 1;
    read.material.textures[slot.slot] = use;
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

// Reads alphaMode and its related values.
void read_alpha(const json &material, const Place &place, glint_material &result)
{
    const std::string mode = optional_text(material, place, "alphaMode");
    if (!mode.empty() && mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
        refuse(place / "alphaMode", in_quotes(mode) + " is none (OPAQUE, MASK or BLEND)");
    }
    result.alpha_mode = mode == "MASK"    ? GLINT_ALPHA_MASK
                        : mode == "BLEND" ? GLINT_ALPHA_BLEND
                                          : GLINT_ALPHA_OPAQUE;
    result.alpha_cutoff = factor_from(material, place, "alphaCutoff", 0, 0.5);
}

void read_normal_scale(const json &object, const Place &place, const char *key, float &result)
{
    const json *normal = optional_object(object, place, key);
    const json *scale = normal == nullptr ? nullptr : member(*normal, "scale");
    if (scale != nullptr) {
        result =
            static_cast<float>(number_within(*scale, place / key / "scale", -FLT_MAX, FLT_MAX));
    }
}

void read_texture_factors(const json &material, const Place &place, glint_material &result)
{
    read_normal_scale(material, place, "normalTexture", result.normal_scale);
    if (const json *occlusion = optional_object(material, place, "occlusionTexture")) {
        result.occlusion_strength = factor(*occlusion, place / "occlusionTexture", "strength", 1);
    }
}

void read_clearcoat(const json &object, const Place &place, glint_material &result)
{
    result.clearcoat = factor(object, place, "clearcoatFactor", 0);
    result.clearcoat_roughness = factor(object, place, "clearcoatRoughnessFactor", 0);
    read_normal_scale(object, place, "clearcoatNormalTexture", result.clearcoat_normal_scale);
}

void read_anisotropy(const json &object, const Place &place, glint_material &result)
{
    result.anisotropy = factor(object, place, "anisotropyStrength", 0);
    const json *rotation = member(object, "anisotropyRotation");
    if (rotation != nullptr) {
        result.anisotropy_rotation = static_cast<float>(
            number_within(*rotation, place / "anisotropyRotation", -FLT_MAX, FLT_MAX));
    }
}

void read_sheen(const json &object, const Place &place, glint_material &result)
{
    color(object, place, "sheenColorFactor", 3, result.sheen_color);
    result.sheen_roughness = factor(object, place, "sheenRoughnessFactor", 0);
}

void read_diffuse_transmission(const json &object, const Place &place, glint_material &result)
{
    result.diffuse_transmission = factor(object, place, "diffuseTransmissionFactor", 0);
    color(object, place, "diffuseTransmissionColorFactor", 3, result.diffuse_transmission_color);
}

void read_iridescence(const json &object, const Place &place, glint_material &result)
{
    result.iridescence = factor(object, place, "iridescenceFactor", 0);
    result.iridescence_ior = factor_from(object, place, "iridescenceIor", 1, 1.3);
    result.iridescence_thickness[0] =
        factor_from(object, place, "iridescenceThicknessMinimum", 0, 100);
    result.iridescence_thickness[1] =
        factor_from(object, place, "iridescenceThicknessMaximum", 0, 400);
}

void read_volume(const json &object, const Place &place, glint_material &result)
{
    result.thickness = factor_from(object, place, "thicknessFactor", 0, 0);
    color(object, place, "attenuationColor", 3, result.attenuation_color);
    const json *distance = member(object, "attenuationDistance");
    if (distance != nullptr) {
        double value = number_of(*distance, place / "attenuationDistance");
        // If the value exceeds a float, no path is long enough for any absorption.
        result.attenuation_distance = value > FLT_MAX ? INFINITY : static_cast<float>(value);
        if (!(result.attenuation_distance > 0)) {
            refuse(place / "attenuationDistance",
                   shown(value) + " is no distance (metres, more than 0; leave it out for clear "
                                  "glass)");
        }
    }
}

double brightness(const float rgb[3])
{
    return std::sqrt(0.299 * double(rgb[0]) * double(rgb[0]) +
                     0.587 * double(rgb[1]) * double(rgb[1]) +
                     0.114 * double(rgb[2]) * double(rgb[2]));
}

// The metallic value m of a surface with this diffuse and specular brightness. A base colour b then
// gives both: (1 − m) b and 0.04 (1 − m) + m b. `left` is the light that the specular colour
// leaves.
double metallic_of(double diffuse, double specular, double left)
{
    constexpr double dielectric = 0.04;
    if (specular < dielectric) {
        return 0;
    }
    const double b = diffuse * left / (1 - dielectric) + specular - 2 * dielectric;
    const double d = std::max(b * b - 4 * dielectric * (dielectric - specular), 0.0);
    return std::clamp((std::sqrt(d) - b) / (2 * dielectric), 0.0, 1.0);
}

// Converts KHR_materials_pbrSpecularGlossiness like the example in its specification. It replaces
// pbrMetallicRoughness.
void read_specular_glossiness(const json &object, const Place &place, glint_material &result)
{
    float diffuse[4] = {1, 1, 1, 1}, specular[3] = {1, 1, 1};
    color(object, place, "diffuseFactor", 4, diffuse);
    color(object, place, "specularFactor", 3, specular);
    const double left = 1 - double(std::max(specular[0], std::max(specular[1], specular[2])));
    const double metallic = metallic_of(brightness(diffuse), brightness(specular), left);
    for (int k = 0; k < 3; k++) {
        const double of_paint = double(diffuse[k]) * left / 0.96 / std::max(1 - metallic, 1e-4);
        const double of_metal =
            (double(specular[k]) - 0.04 * (1 - metallic)) / std::max(metallic, 1e-4);
        const double mixed = of_paint + metallic * metallic * (of_metal - of_paint);
        result.base_color[k] = static_cast<float>(std::clamp(mixed, 0.0, 1.0));
    }
    result.metallic = static_cast<float>(metallic);
    result.roughness = 1 - factor(object, place, "glossinessFactor", 1);
    result.alpha = diffuse[3];
}

// Reads a colour that may be brighter than white.
void read_specular_color(const json &object, const Place &object_place, float *result)
{
    const json *found = member(object, "specularColorFactor");
    if (found == nullptr) {
        return;
    }
    const Place place = object_place / "specularColorFactor";
    if (!found->is_array() || found->size() != 3) {
        refuse(place, "not an array of 3 numbers");
    }
    for (std::size_t i = 0; i < 3; i++) {
        const double value = number_of((*found)[i], place[i]);
        if (!(value >= -1e-6 && value <= FLT_MAX)) { // an exporter may round to just below 0
            refuse(place[i], shown(value) + " is out of range (give 0 or more)");
        }
        result[i] = static_cast<float>(std::max(value, 0.0));
    }
}

void read_extensions(const json &material, const Place &place, glint_material &result)
{
    Place at = place / "extensions";
    if (const json *found = extension_of(material, place, "KHR_materials_transmission")) {
        result.transmission =
            factor(*found, at / "KHR_materials_transmission", "transmissionFactor", 0);
    }
    if (const json *found = extension_of(material, place, specular_glossiness)) {
        read_specular_glossiness(*found, at / specular_glossiness, result);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_ior")) {
        result.ior = read_ior(*found, at / "KHR_materials_ior");
    }
    if (const json *found = extension_of(material, place, "KHR_materials_volume")) {
        read_volume(*found, at / "KHR_materials_volume", result);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_dispersion")) {
        result.dispersion =
            factor_from(*found, at / "KHR_materials_dispersion", "dispersion", 0, 0);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_specular")) {
        Place in = at / "KHR_materials_specular";
        result.specular = factor(*found, in, "specularFactor", 1);
        read_specular_color(*found, in, result.specular_color);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_clearcoat")) {
        read_clearcoat(*found, at / "KHR_materials_clearcoat", result);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_anisotropy")) {
        read_anisotropy(*found, at / "KHR_materials_anisotropy", result);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_sheen")) {
        read_sheen(*found, at / "KHR_materials_sheen", result);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_diffuse_transmission")) {
        read_diffuse_transmission(*found, at / "KHR_materials_diffuse_transmission", result);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_iridescence")) {
        read_iridescence(*found, at / "KHR_materials_iridescence", result);
    }
    if (const json *found = extension_of(material, place, "KHR_materials_emissive_strength")) {
        float strength =
            factor_from(*found, at / "KHR_materials_emissive_strength", "emissiveStrength", 0, 1);
        for (float &component : result.emission) {
            component *= strength;
        }
    }
    result.unlit = extension_of(material, place, "KHR_materials_unlit") != nullptr;
}

// Reads the lecture's blend and the priority of solids: extras {"glint": {"mirror": m, "priority":
// p}}. Extras of other programs may hold anything.
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
    const json *priority = member(object, "priority");
    if (priority != nullptr) {
        result.priority =
            static_cast<float>(number_within(*priority, at / "priority", -1000000, 1000000));
    }
}

// Reads a material without its textures.
glint_material read_one(const json &material, const Place &place)
{
    glint_material result = glint_material_default;
    if (const json *metal = optional_object(material, place, "pbrMetallicRoughness")) {
        Place at = place / "pbrMetallicRoughness";
        float rgba[4] = {1, 1, 1, 1};
        color(*metal, at, "baseColorFactor", 4, rgba);
        std::copy(rgba, rgba + 3, result.base_color);
        result.alpha = rgba[3];
        result.metallic = factor(*metal, at, "metallicFactor", 1);
        result.roughness = factor(*metal, at, "roughnessFactor", 1);
    }
    color(material, place, "emissiveFactor", 3, result.emission);
    read_alpha(material, place, result);
    read_texture_factors(material, place, result);
    read_extensions(material, place, result);
    read_extras(material, place, result);
    return result;
}

void check_slots(const json &root, const json &material, const Place &place)
{
    for (const TextureSlot &slot : texture_slots()) {
        const json *holder = holder_of(material, place, slot);
        if (holder != nullptr && member(*holder, slot.key) != nullptr) {
            const Place at = place_of(place, slot);
            check_texture_info(root, object_at(*holder, at, slot.key), at / slot.key);
        }
    }
}

// Makes the surface mid-grey paint, because nothing is known of it.
void make_grey(glint_material &material)
{
    std::fill(material.base_color, material.base_color + 3, 0.5F);
    material.metallic = 0;
    material.roughness = 1;
    material.transmission = 0;
    material.clearcoat = 0;
    material.iridescence = 0;
    material.anisotropy = 0;
    material.diffuse_transmission = 0;
    std::fill(material.sheen_color, material.sheen_color + 3, 0.0F);
    for (const glint_texture_slot slot :
         {GLINT_TEXTURE_BASE_COLOR, GLINT_TEXTURE_METALLIC_ROUGHNESS, GLINT_TEXTURE_TRANSMISSION,
          GLINT_TEXTURE_SPECULAR, GLINT_TEXTURE_SPECULAR_COLOR, GLINT_TEXTURE_CLEARCOAT,
          GLINT_TEXTURE_CLEARCOAT_ROUGHNESS, GLINT_TEXTURE_CLEARCOAT_NORMAL,
          GLINT_TEXTURE_IRIDESCENCE, GLINT_TEXTURE_IRIDESCENCE_THICKNESS, GLINT_TEXTURE_ANISOTROPY,
          GLINT_TEXTURE_SHEEN_COLOR, GLINT_TEXTURE_SHEEN_ROUGHNESS,
          GLINT_TEXTURE_DIFFUSE_TRANSMISSION, GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR}) {
        material.textures[slot] = {};
    }
}

// Sets a substitute for a texture that cannot be shown. Returns its description.
const char *do_without(glint_texture_slot slot, UsedMaterial &used)
{
    glint_material &material = used.material;
    if (used.is_replaced) {
        return "the colour's factor alone is used"; // a preset keeps no other texture
    }
    switch (slot) {
    case GLINT_TEXTURE_NORMAL:
        return "the mesh's own normals are used";
    case GLINT_TEXTURE_OCCLUSION:
        return "nothing is darkened";
    case GLINT_TEXTURE_EMISSION:
        std::fill(material.emission, material.emission + 3, 0.0F);
        return "nothing is emitted";
    case GLINT_TEXTURE_CLEARCOAT_NORMAL:
        return "the coat has the mesh's own normals";
    case GLINT_TEXTURE_SPECULAR:
    case GLINT_TEXTURE_SPECULAR_COLOR:
    case GLINT_TEXTURE_CLEARCOAT:
    case GLINT_TEXTURE_CLEARCOAT_ROUGHNESS:
    case GLINT_TEXTURE_IRIDESCENCE:
    case GLINT_TEXTURE_IRIDESCENCE_THICKNESS:
    case GLINT_TEXTURE_ANISOTROPY:
    case GLINT_TEXTURE_SHEEN_COLOR:
    case GLINT_TEXTURE_DIFFUSE_TRANSMISSION:
    case GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR:
    case GLINT_TEXTURE_SHEEN_ROUGHNESS:
        return "its factor alone is used";
    default:
        make_grey(material);
        return "the surface is rendered as grey paint";
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
        optional_text(material, place, "name");
        optional_boolean(material, place, "doubleSided", false);
        read_one(material, place);
        check_slots(root, material, place);
    }
}

glint_material read_factors(const json &root, std::ptrdiff_t index)
{
    const json &materials = objects_of(root, "materials");
    const auto i = static_cast<std::size_t>(index);
    glint_material result =
        index < 0 ? glint_material_default : read_one(materials[i], (Place() / "materials")[i]);
    result.index = static_cast<int>(index < 0 ? materials.size() : i);
    return result;
}

UsedMaterial read_material(const json &root, std::ptrdiff_t index)
{
    UsedMaterial read;
    read.material = read_factors(root, index);
    if (index < 0) {
        return read;
    }
    const auto i = static_cast<std::size_t>(index);
    const json &material = objects_of(root, "materials")[i];
    for (const TextureSlot &slot : texture_slots()) {
        const json *holder = holder_of(material, (Place() / "materials")[i], slot);
        const json *info = holder == nullptr ? nullptr : member(*holder, slot.key);
        if (info != nullptr) {
            take_texture(root, *info, slot, read);
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

void settle_material(const json &root, std::ptrdiff_t index, const Images &images,
                     UsedMaterial &used, Tally &tally)
{
    const Tally::About about(tally, used.material.index);
    for (const TextureSlot &slot : texture_slots()) {
        glint_texture_use &use = used.material.textures[slot.slot];
        if (use.image != 0 && !images.fault(use.image).empty()) {
            used.missing.push_back({slot.slot, slot.key, images.fault(use.image)});
            use = {};
        }
    }
    for (const MissingTexture &missing : used.missing) {
        if (used.is_replaced && missing.slot != GLINT_TEXTURE_BASE_COLOR) {
            continue;
        }
        const std::string instead = do_without(missing.slot, used);
        tally.add(missing.key + ": " + missing.why + "; " + instead, where_is(root, index));
    }
}

std::string material_name(const json &root, std::ptrdiff_t index)
{
    return index < 0 ? ""
                     : optional_text(objects_of(root, "materials")[static_cast<std::size_t>(index)],
                                     Place(), "name");
}

void survey_material(const json &root, std::ptrdiff_t index, const UsedMaterial &used, Tally &tally)
{
    const Tally::About about(tally, used.material.index);
    const std::string where = where_is(root, index);
    const glint_lobes lobes = glint_material_lobes(&used.material);
    if (lobes.solid && used.material.alpha_mode != GLINT_ALPHA_OPAQUE) {
        tally.add("alphaMode counts for nothing in glass with a volume: it is all there", where);
    }
    if (index >= 0 && !used.is_replaced) {
        const json &material = objects_of(root, "materials")[static_cast<std::size_t>(index)];
        survey_extensions(material, Holder::material, where, tally);
        survey_extras(material, where, tally);
    }
}

} // namespace glint
