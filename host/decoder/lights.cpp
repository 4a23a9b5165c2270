// Reads punctual lights. See lights.hpp.
#include "decoder/lights.hpp"

#include <algorithm>
#include <cmath>

namespace glint
{

namespace
{

constexpr double half_pi = 1.57079632679489661923;
const char *const name_of_extension = "KHR_lights_punctual";

using Notes = std::vector<std::string>;

// Refuses light that takes light away.
double read_positive(const json &object, const Place &place, const char *key, double fallback)
{
    const json *found = member(object, key);
    const double number = found == nullptr ? fallback : number_of(*found, place / key);
    if (number < 0) {
        refuse(place / key, std::string(key) + " is less than 0");
    }
    return number;
}

std::vector<double> read_color(const json &light, const Place &light_place, Notes &notes)
{
    std::vector<double> color = {1, 1, 1};
    const Place place = light_place / "color";
    const json &found = optional_array(light, light_place, "color");
    if (member(light, "color") != nullptr && found.size() != color.size()) {
        notes.emplace_back("color has not 3 numbers");
    }
    for (std::size_t i = 0; i < std::min(found.size(), color.size()); i++) {
        color[i] = number_of(found[i], place[i]);
        if (color[i] < 0) {
            refuse(place, "color is less than 0");
        }
    }
    return color;
}

// Returns the range; 0: unlimited.
double read_range(const json &light, const Place &place, Notes &notes)
{
    const json *found = member(light, "range");
    const double range = found == nullptr ? 0 : number_of(*found, place / "range");
    if (found != nullptr && !(range > 0)) {
        notes.emplace_back("range is no distance (it counts as unlimited)");
        return 0;
    }
    return range;
}

tinygltf::SpotLight read_spot(const json &light, const Place &light_place, Notes &notes)
{
    const Place place = light_place / "spot";
    const json &source = object_at(light, light_place, "spot");
    auto angle = [&](const char *key, double fallback, double most) {
        const json *found = member(source, key);
        const double number = found == nullptr ? fallback : number_of(*found, place / key);
        if (!(number >= 0 && number <= most + 1e-6)) { // exporters round
            notes.push_back(std::string(key) +
                            " is out of range (the nearest angle within counts)");
        }
        return std::min(std::max(number, 0.0), most);
    };
    tinygltf::SpotLight spot;
    spot.outerConeAngle = angle("outerConeAngle", half_pi / 2, half_pi);
    // Equal cones have a hard edge. Blender's exporter writes them.
    spot.innerConeAngle = angle("innerConeAngle", 0, spot.outerConeAngle);
    return spot;
}

tinygltf::Light read_light(const json &source, const Place &place, Notes &notes)
{
    expect_object(source, place);
    tinygltf::Light light;
    const std::string type = optional_text(source, place, "type");
    if (type != "spot" && type != "point" && type != "directional") {
        refuse(place / "type", "type " + in_quotes(type) + " is none (directional, point or spot)");
    }
    light.name = name_of(source);
    light.color = read_color(source, place, notes);
    light.intensity = read_positive(source, place, "intensity", 1);
    light.range = read_range(source, place, notes);
    if (type == "spot") {
        light.spot = read_spot(source, place, notes);
    }
    light.type = type;
    return light;
}

} // namespace

void read_lights(const json &root, Model &model)
{
    const Place place = Place() / "extensions" / name_of_extension;
    try {
        const json *extension = extension_of(root, Place(), name_of_extension);
        if (extension == nullptr) {
            return;
        }
        const json &lights = optional_array(*extension, place, "lights");
        model.lights.resize(lights.size());
        model.light_notes.resize(lights.size());
        for (std::size_t i = 0; i < lights.size(); i++) {
            try {
                model.lights[i] =
                    read_light(lights[i], (place / "lights")[i], model.light_notes[i]);
            } catch (const refusal &fault) {
                model.light_notes[i] = {fault.cause() + "; the light is left out"};
            }
        }
    } catch (const refusal &) {
        model.lights.clear(); // nodes say that their lights are not there
    }
}

int read_node_light(const json &node, const Place &place, std::size_t index, Model &model)
{
    try {
        const json *extension = extension_of(node, place, name_of_extension);
        const Place at = place / "extensions" / name_of_extension;
        if (extension == nullptr) {
            return -1;
        }
        const auto light =
            static_cast<int>(optional_index(*extension, at, "light", model.lights.size(), "light"));
        if (light < 0) {
            refuse(at, "it names no light");
        }
        return light;
    } catch (const refusal &fault) {
        model.node_notes[index].push_back(fault.cause() + "; the node has no light");
        return -1;
    }
}

} // namespace glint
