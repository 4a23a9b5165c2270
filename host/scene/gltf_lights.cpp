// Checks punctual lights as part of the document, and places them at their nodes. See
// gltf_lights.hpp.
#include "scene/gltf_lights.hpp"

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

double check_positive(const json &object, const Place &place, const char *key, double fallback)
{
    const json *found = member(object, key);
    const double number = found == nullptr ? fallback : number_of(*found, place / key);
    if (number < 0) {
        refuse(place / key, shown(number) + " is less than 0 (light cannot be taken away)");
    }
    return number;
}

std::vector<double> check_color(const json &light, const Place &light_place)
{
    std::vector<double> color = {1, 1, 1};
    const json *found = member(light, "color");
    if (found == nullptr) {
        return color;
    }
    const Place place = light_place / "color";
    if (!found->is_array() || found->size() != color.size()) {
        refuse(place, "it must be an array of 3 numbers");
    }
    for (std::size_t i = 0; i < color.size(); i++) {
        color[i] = number_of((*found)[i], place[i]);
        if (color[i] < 0) {
            refuse(place[i], shown(color[i]) + " is less than 0 (light cannot be taken away)");
        }
    }
    return color;
}

// Returns the range; 0: unlimited.
double check_range(const json &light, const Place &place)
{
    const json *found = member(light, "range");
    const double range = found == nullptr ? 0 : number_of(*found, place / "range");
    if (found != nullptr && !(range > 0)) {
        refuse(place / "range",
               shown(range) + ": it must be more than 0 (leave it out for a light without an end)");
    }
    return range;
}

tinygltf::SpotLight check_spot(const json &light, const Place &light_place)
{
    const Place place = light_place / "spot";
    const json &source = object_at(light, light_place, "spot");
    tinygltf::SpotLight spot;
    spot.innerConeAngle = check_positive(source, place, "innerConeAngle", 0);
    const json *outer = member(source, "outerConeAngle");
    spot.outerConeAngle = outer == nullptr
                              ? half_pi / 2
                              : number_within(*outer, place / "outerConeAngle", 0, half_pi);
    if (!(spot.innerConeAngle < spot.outerConeAngle)) {
        refuse(place / "innerConeAngle", shown(spot.innerConeAngle) +
                                             " is not less than the outerConeAngle, " +
                                             shown(spot.outerConeAngle) + " (make it smaller)");
    }
    return spot;
}

tinygltf::Light check_light(const json &source, const Place &place)
{
    expect_object(source, place);
    tinygltf::Light light;
    light.name = optional_text(source, place, "name");
    light.type = optional_text(source, place, "type");
    light.color = check_color(source, place);
    light.intensity = check_positive(source, place, "intensity", 1);
    light.range = check_range(source, place);
    if (light.type == "spot") {
        light.spot = check_spot(source, place);
    } else if (light.type != "point" && light.type != "directional") {
        refuse(place / "type", in_quotes(light.type) + " is none (directional, point or spot)");
    }
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

void check_lights(const json &root, Model &model)
{
    const json *extension = extension_of(root, Place(), name_of_extension);
    if (extension == nullptr) {
        return;
    }
    const Place place = Place() / "extensions" / name_of_extension;
    const json &lights = array_at(*extension, place, "lights");
    for (std::size_t i = 0; i < lights.size(); i++) {
        model.lights.push_back(check_light(lights[i], (place / "lights")[i]));
    }
}

int check_node_light(const json &node, const Place &place, const Model &model)
{
    const json *extension = extension_of(node, place, name_of_extension);
    if (extension == nullptr) {
        return -1;
    }
    const Place at = place / "extensions" / name_of_extension;
    const json *light = member(*extension, "light");
    if (light == nullptr) {
        refuse(at / "light", "missing (KHR_lights_punctual requires it)");
    }
    return static_cast<int>(index_of(*light, at / "light", model.lights.size(), "light"));
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
