// Reads punctual lights, and places them at their nodes. See lights.hpp.
#include "scene/gltf/lights.hpp"

#include "base/memory.h"

#include <algorithm>
#include <cmath>
#include <new>

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

glint_punctual_kind kind_of(const tinygltf::Light &light)
{
    return light.type == "spot"    ? GLINT_PUNCTUAL_SPOT
           : light.type == "point" ? GLINT_PUNCTUAL_POINT
                                   : GLINT_PUNCTUAL_DIRECTIONAL;
}

bool is_finite(glint_vec3 v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
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

void allocate_lights(const Load &load, glint_scene &scene)
{
    const auto count = static_cast<std::size_t>(
        std::count_if(load.visits.begin(), load.visits.end(), [&](const Visit &visit) {
            return visit.is_shown && load.model.light_of[visit.node] >= 0;
        }));
    scene.lights =
        static_cast<glint_punctual_light *>(glint_allocate(count, sizeof(glint_punctual_light)));
    if (scene.lights == nullptr) {
        throw std::bad_alloc();
    }
}

void add_light(Load &load, std::size_t node, const glint_mat4 &to_world, glint_scene &scene)
{
    const auto index = static_cast<std::size_t>(load.model.light_of[node]);
    const tinygltf::Light &source = load.model.lights[index];
    for (const std::string &note : load.model.light_notes[index]) {
        load.tally.add(note, "lights[" + std::to_string(index) + "]" +
                                 (source.name.empty() ? "" : " " + in_quotes(source.name)));
    }
    if (source.type.empty()) {
        return;
    }
    const auto &m = to_world.m;
    glint_punctual_light &light = scene.lights[scene.light_count];
    light = {};
    light.kind = kind_of(source);
    light.node_index = static_cast<int>(node);
    light.position = {m[0][3], m[1][3], m[2][3]};
    light.direction = glint_vec3_normalize({-m[0][2], -m[1][2], -m[2][2]});
    const bool has_direction = glint_vec3_length(light.direction) > 0;
    if (!is_finite(light.position) || (light.kind != GLINT_PUNCTUAL_POINT && !has_direction)) {
        load.tally.add("the light shines nowhere (the node's scale is 0, or its place not finite) "
                       "and is left out",
                       "nodes[" + std::to_string(node) + "]");
        return;
    }
    for (std::size_t i = 0; i < 3; i++) {
        light.color[i] = source.color[i] * source.intensity;
    }
    light.range = source.range > 0 ? source.range : INFINITY;
    light.inner_angle = source.spot.innerConeAngle;
    light.outer_angle = source.spot.outerConeAngle;
    const std::string &name = load.model.nodes[node].name;
    light.name = copy_text(name.empty() ? source.name : name);
    scene.light_count++;
}

} // namespace glint
