// Reads the factors of materials. See factors.hpp.
#include "decoder/factors.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace glint
{

namespace
{

struct Range {
    double low, high;
};

// The ranges of the factors, by their names.
namespace range
{
#define RANGE_OF(kind, name, least, most, ...) constexpr Range name = {least, most};
GLINT_MATERIAL_TABLE(RANGE_OF)
#undef RANGE_OF
} // namespace range

constexpr Range share = {0, 1};

// Reads the numbers of an object.
class Numbers
{
  public:
    Numbers(const json &object, const Place &place, std::vector<Note> &notes)
        : object_(object), place_(place), notes_(notes)
    {
    }

    float number(const char *key, Range range, double fallback) const
    {
        const json *found = member(object_, key);
        return static_cast<float>(
            found == nullptr ? fallback : within(number_of(*found, place_ / key), key, range));
    }

    // Reads `count` numbers. Those that are missing stay as they are.
    void color(const char *key, std::size_t count, Range range, float *result) const
    {
        const json &found = optional_array(object_, place_, key);
        if (member(object_, key) != nullptr && found.size() != count) {
            note(key, "has not " + std::to_string(count) +
                          " numbers (missing ones are glTF's "
                          "defaults)");
        }
        for (std::size_t i = 0; i < std::min(count, found.size()); i++) {
            const double number = number_of(found[i], (place_ / key)[i]);
            result[i] = static_cast<float>(within(number, key, range));
        }
    }

    // The numbers of a member; of an empty object if there is none.
    Numbers of(const char *key) const
    {
        static const json nothing = json::object();
        const json *found = optional_object(object_, place_, key);
        return {found == nullptr ? nothing : *found, place_ / key, notes_};
    }

    void note(const std::string &key, const std::string &text) const
    {
        notes_.push_back({"", key + " " + text});
    }

    const json &object() const
    {
        return object_;
    }

    const Place &place() const
    {
        return place_;
    }

  private:
    double within(double number, const char *key, Range range) const
    {
        // Exporters compute in floats: their rounding is no fault.
        constexpr double slack = 1e-6;
        if (!(number >= range.low - slack && number <= range.high + slack)) {
            note(key, "is out of range (the nearest value within counts)");
        }
        return std::min(std::max(number, range.low), range.high);
    }

    const json &object_;
    Place place_;
    std::vector<Note> &notes_;
};

// ---- Extensions ---------------------------------------------------------------------------------

// An index of 0 means an infinite one, for materials that come from specular and glossiness: the
// surface reflects all (KHR_materials_ior). Then nothing disperses.
void read_ior(const Numbers &from, glint_material &result)
{
    const json *found = member(from.object(), "ior");
    const double ior = found == nullptr ? 1.5 : number_of(*found, from.place() / "ior");
    if (ior == 0 || ior > double(GLINT_IOR_INFINITE)) {
        result.ior = GLINT_IOR_INFINITE;
        result.dispersion = 0;
        return;
    }
    result.ior = from.number("ior", range::ior, 1.5);
}

void read_thickness_of_film(const Numbers &from, glint_material &result)
{
    float *thickness = result.iridescence_thickness;
    thickness[0] = from.number("iridescenceThicknessMinimum", range::iridescence_thickness,
                               double(thickness[0]));
    thickness[1] = from.number("iridescenceThicknessMaximum", range::iridescence_thickness,
                               double(thickness[1]));
}

void read_distance(const Numbers &from, glint_material &result)
{
    const json *distance = member(from.object(), "attenuationDistance");
    if (distance == nullptr) { // or null: JSON cannot store infinity
        return;
    }
    const double value = number_of(*distance, from.place() / "attenuationDistance");
    if (!(value > 0)) {
        from.note("attenuationDistance", "is no distance (it counts as infinite)");
        return;
    }
    // If the value exceeds a float, no path is long enough for any absorption.
    result.attenuation_distance =
        value > FLT_MAX ? INFINITY : std::max(static_cast<float>(value), FLT_MIN);
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
void read_specular_glossiness(const Numbers &from, glint_material &result)
{
    float diffuse[4] = {1, 1, 1, 1}, specular[3] = {1, 1, 1};
    from.color("diffuseFactor", 4, share, diffuse);
    from.color("specularFactor", 3, share, specular);
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
    result.roughness = 1 - from.number("glossinessFactor", share, 1);
    result.alpha = diffuse[3];
}

// Reads the values whose rows have a key.
void read_plain_values(const Numbers &material, glint_material &result)
{
    const Numbers extensions = material.of("extensions");
    for (std::size_t i = 0; i < glint_material_value_count; i++) {
        const glint_material_value &value = glint_material_values[i];
        if (value.key == nullptr) {
            continue;
        }
        const Numbers from = value.extension == nullptr ? material.of("pbrMetallicRoughness")
                                                        : extensions.of(value.extension);
        auto *numbers = reinterpret_cast<float *>(reinterpret_cast<char *>(&result) + value.offset);
        const Range range = {value.least, value.most};
        if (value.count == 1) {
            *numbers = from.number(value.key, range, double(*numbers));
        } else {
            from.color(value.key, static_cast<std::size_t>(value.count), range, numbers);
        }
    }
}

void read_extensions(const Numbers &material, glint_material &result)
{
    const Numbers extensions = material.of("extensions");
    if (member(extensions.object(), specular_glossiness) != nullptr) {
        read_specular_glossiness(extensions.of(specular_glossiness), result);
    }
    read_distance(extensions.of("KHR_materials_volume"), result);
    read_ior(extensions.of("KHR_materials_ior"), result);
    result.clearcoat_normal_scale = extensions.of("KHR_materials_clearcoat")
                                        .of("clearcoatNormalTexture")
                                        .number("scale", range::clearcoat_normal_scale, 1);
    read_thickness_of_film(extensions.of("KHR_materials_iridescence"), result);
    const float strength = extensions.of("KHR_materials_emissive_strength")
                               .number("emissiveStrength", range::emission, 1);
    for (float &component : result.emission) {
        component = std::min(component * strength, FLT_MAX);
    }
    result.unlit =
        extension_of(material.object(), material.place(), "KHR_materials_unlit") != nullptr;
}

// Reads the lecture's blend and the priority of solids: extras {"glint": {"mirror": m, "priority":
// p}}. Extras of other programs may hold anything.
void read_extras(const Numbers &material, glint_material &result)
{
    const json *extras = member(material.object(), "extras");
    if (extras == nullptr || !extras->is_object()) {
        return;
    }
    const Numbers ours = material.of("extras").of("glint");
    result.mirror = member(ours.object(), "mirror") == nullptr ? result.mirror
                                                               : ours.number("mirror", share, 0);
    result.priority = ours.number("priority", range::priority, 0);
}

// Reads alphaMode and its related values.
void read_alpha(const Numbers &from, glint_material &result)
{
    const std::string mode = optional_text(from.object(), from.place(), "alphaMode");
    if (!mode.empty() && mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
        from.note("alphaMode", "is none that there is (it counts as OPAQUE)");
    }
    result.alpha_mode = mode == "MASK"    ? GLINT_ALPHA_MASK
                        : mode == "BLEND" ? GLINT_ALPHA_BLEND
                                          : GLINT_ALPHA_OPAQUE;
    result.alpha_cutoff = from.number("alphaCutoff", range::alpha_cutoff, 0.5);
}

} // namespace

glint_material read_factors_at(const json &object, const Place &place, std::vector<Note> &notes)
{
    const Numbers material(object, place, notes);
    glint_material result = glint_material_default;
    const Numbers metal = material.of("pbrMetallicRoughness");
    float rgba[4] = {1, 1, 1, 1};
    metal.color("baseColorFactor", 4, share, rgba);
    std::copy(rgba, rgba + 3, result.base_color);
    result.alpha = rgba[3];
    read_plain_values(material, result);
    // Older exporters wrote bright lamps without KHR_materials_emissive_strength.
    material.color("emissiveFactor", 3, range::emission, result.emission);
    read_alpha(material, result);
    result.normal_scale = material.of("normalTexture").number("scale", range::normal_scale, 1);
    result.occlusion_strength =
        material.of("occlusionTexture").number("strength", range::occlusion_strength, 1);
    read_extensions(material, result);
    read_extras(material, result);
    return result;
}

} // namespace glint
