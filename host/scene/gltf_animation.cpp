// Checks and reads animations of a glTF file. See gltf_animation.hpp.
#include "scene/gltf_animation.hpp"

#include "base/free_memory.h"
#include "scene/gltf_accessor.hpp"
#include "scene/gltf_check_storage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace glint
{

namespace
{

// ---- Checks ------------------------------------------------------------------------------------

constexpr std::array<const char *, 4> paths = {"translation", "rotation", "scale", "weights"};

// Returns the property of a path; paths.size() if glint does not model it.
std::size_t property_of(const std::string &path)
{
    return static_cast<std::size_t>(std::find(paths.begin(), paths.end(), path) - paths.begin());
}

glint_interpolation interpolation_of(const json &sampler, const Place &place)
{
    std::string name = optional_text(sampler, place, "interpolation");
    if (name.empty() || name == "LINEAR") {
        return GLINT_INTERPOLATION_LINEAR;
    }
    if (name == "STEP") {
        return GLINT_INTERPOLATION_STEP;
    }
    if (name == "CUBICSPLINE") {
        return GLINT_INTERPOLATION_CUBIC;
    }
    refuse(place / "interpolation",
           in_quotes(name) + " is none (LINEAR, STEP or CUBICSPLINE is expected)");
}

void check_sampler(const json &sampler, const Place &place, const Model &model)
{
    const auto &accessors = model.accessors;
    for (const char *key : {"input", "output"}) {
        if (optional_index(sampler, place, key, accessors.size(), "accessor") < 0) {
            refuse(place / key, "missing (glTF 2.0 requires it)");
        }
    }
    const tinygltf::Accessor &times = accessors[sampler["input"].get<std::size_t>()];
    check_format(times, place / "input", {TINYGLTF_TYPE_SCALAR, true, false, false});
    interpolation_of(sampler, place);
}

// The number of values per key: 1, or 3 with tangents.
std::size_t values_a_key(const json &sampler, const Place &place)
{
    return interpolation_of(sampler, place) == GLINT_INTERPOLATION_CUBIC ? 3 : 1;
}

// The number of morph targets that a node's curve of weights moves; 0 if the node has none.
std::size_t targets_of(const Model &model, const json &target)
{
    const json *node = member(target, "node");
    const int mesh = node == nullptr ? -1 : model.nodes[node->get<std::size_t>()].mesh;
    return mesh < 0 ? 0 : model.target_counts[static_cast<std::size_t>(mesh)];
}

// Checks a channel's sampler for its property; `targets` is the number of morph targets.
void check_output(const json &sampler, const Place &place, std::size_t property,
                  std::size_t targets, const Model &model)
{
    const tinygltf::Accessor &output = model.accessors[sampler["output"].get<std::size_t>()];
    const std::uint64_t keys = model.accessors[sampler["input"].get<std::size_t>()].count;
    const std::uint64_t values = output.count;
    const bool is_vector = property == translation || property == scale;
    const int type = is_vector              ? TINYGLTF_TYPE_VEC3
                     : property == rotation ? TINYGLTF_TYPE_VEC4
                                            : TINYGLTF_TYPE_SCALAR;
    check_format(output, place / "output", {type, true, !is_vector, false, !is_vector});
    const std::uint64_t each = values_a_key(sampler, place);
    const std::uint64_t numbers = each * (property == weights ? targets : 1);
    if (values % numbers != 0 || values / numbers != keys) { // a product could overflow
        refuse(place / "output",
               counted(values, "value") + " for " + counted(keys, "key") +
                   (property == weights ? " of " + counted(targets, "morph target") : "") +
                   (each == 3 ? ", which have three each" : "") + " (the file is damaged)");
    }
}

void check_channel(const json &channel, const Place &place, const json &samplers,
                   const Place &samplers_place, const Model &model)
{
    std::ptrdiff_t sampler = optional_index(channel, place, "sampler", samplers.size(), "sampler");
    if (sampler < 0) {
        refuse(place / "sampler", "missing (glTF 2.0 requires it)");
    }
    const json &target = object_at(channel, place, "target");
    optional_index(target, place / "target", "node", model.nodes.size(), "node");
    std::string path = optional_text(target, place / "target", "path");
    if (path.empty()) {
        refuse(place / "target" / "path", "missing (glTF 2.0 requires it)");
    }
    const std::size_t property = property_of(path);
    const std::size_t targets = targets_of(model, target);
    if (property < paths.size() && (property != weights || targets > 0)) {
        auto index = static_cast<std::size_t>(sampler);
        check_output(samplers[index], samplers_place[index], property, targets, model);
    }
}

} // namespace

void check_animations(const json &root, const Model &model)
{
    const json &animations = objects_of(root, "animations");
    for (std::size_t i = 0; i < animations.size(); i++) {
        Place place = (Place() / "animations")[i];
        optional_text(animations[i], place, "name");
        const json &samplers = array_at(animations[i], place, "samplers");
        const json &channels = array_at(animations[i], place, "channels");
        for (std::size_t k = 0; k < samplers.size(); k++) {
            expect_object(samplers[k], (place / "samplers")[k]);
            check_sampler(samplers[k], (place / "samplers")[k], model);
        }
        for (std::size_t k = 0; k < channels.size(); k++) {
            expect_object(channels[k], (place / "channels")[k]);
            check_channel(channels[k], (place / "channels")[k], samplers, place / "samplers",
                          model);
        }
    }
}

// ---- Reading -----------------------------------------------------------------------------------

namespace
{

std::vector<double> read_times(const Reader &reader, const Place &place)
{
    std::vector<double> times(reader.count());
    for (std::size_t i = 0; i < times.size(); i++) {
        reader.numbers(i, 1, &times[i]);
        if (!std::isfinite(times[i]) || times[i] < 0 || (i > 0 && times[i] <= times[i - 1])) {
            refuse(place / "input", "key " + std::to_string(i) + " is at " + shown(times[i]) +
                                        " s (times must be finite, from 0 and ascend)");
        }
    }
    return times;
}

std::vector<double> read_values(const Reader &reader, std::size_t components, std::size_t each,
                                const Place &place)
{
    std::vector<double> values(reader.count() * components);
    for (std::size_t i = 0; i < reader.count(); i++) {
        double *value = values.data() + i * components;
        reader.numbers(i, components, value);
        double squares = 0;
        for (std::size_t k = 0; k < components; k++) {
            squares += value[k] * value[k];
        }
        bool is_tangent = each == 3 && i % 3 != 1;
        if (!std::isfinite(squares) || (components == 4 && !is_tangent && !(squares > 0))) {
            refuse(place / "output",
                   "value " + std::to_string(i) +
                       (components == 4 ? " is no rotation (a quaternion must be finite and not 0)"
                                        : " is not finite (the file is damaged)"));
        }
    }
    return values;
}

// `components` is the count of numbers in a value.
Curve read_curve(const Model &model, const json &sampler, const Place &place, Property property,
                 std::size_t components)
{
    Curve curve;
    curve.is_rotation = property == rotation;
    curve.components = components;
    curve.interpolation = interpolation_of(sampler, place);
    curve.times = read_times(Reader(model, sampler["input"].get<std::size_t>()), place);
    curve.values = read_values(Reader(model, sampler["output"].get<std::size_t>()),
                               property == weights ? 1 : components, // each weight is a scalar
                               values_a_key(sampler, place), place);
    return curve;
}

// The input and output of reading clips.
struct Reading {
    const Document &document;
    const Model &model;
    Clips &clips;
    Tally &tally;
    std::uint64_t left; // bytes of memory that further curves may take
};

// Counts a curve's memory. Many channels may share a sampler, but each has its own curve.
void take_memory(Reading &reading, std::uint64_t bytes)
{
    if (bytes > reading.left) {
        throw shortage("its animations take more memory than is free (leave some out: "
                       "--animation)");
    }
    reading.left -= bytes;
}

void read_channel(Reading &reading, const json &animation, const Place &place, std::size_t number)
{
    const json &channel = animation["channels"][number];
    const json &target = channel["target"];
    std::string where = (place / "channels")[number].text();
    const std::size_t found = property_of(target["path"].get<std::string>());
    if (found == paths.size() || member(target, "node") == nullptr) {
        reading.tally.add("only translation, rotation, scale and weights of nodes are animated, "
                          "this is left out",
                          where);
        return;
    }
    auto property = static_cast<Property>(found);
    const std::size_t targets = targets_of(reading.model, target);
    if (property == weights && targets == 0) {
        reading.tally.add("the node has no morph targets, the animation of their weights is left "
                          "out",
                          where);
        return;
    }
    auto node = target["node"].get<std::size_t>();
    if (property != weights && !reading.model.nodes[node].matrix.empty()) {
        reading.tally.add("the node has a matrix, which cannot be animated, and stays where it is",
                          where);
        return;
    }
    // Count the memory of the curve, then read it.
    auto sampler = channel["sampler"].get<std::size_t>();
    const json &source = animation["samplers"][sampler];
    const std::size_t numbers = reading.model.accessors[source["input"].get<std::size_t>()].count +
                                reading.model.accessors[source["output"].get<std::size_t>()].count *
                                    (property == weights    ? 1
                                     : property == rotation ? 4
                                                            : 3);
    take_memory(reading, numbers * sizeof(double));
    Curve curve = read_curve(reading.model, animation["samplers"][sampler],
                             (place / "samplers")[sampler], property,
                             property == weights    ? targets
                             : property == rotation ? 4
                                                    : 3);
    reading.clips.duration = std::max(reading.clips.duration, curve.times.back());
    reading.clips.nodes[node].of[property] = std::move(curve);
}

void read_clip(Reading &reading, std::size_t index)
{
    const json &animation = objects_of(reading.document.root, "animations")[index];
    Place place = (Place() / "animations")[index];
    for (std::size_t k = 0; k < animation["channels"].size(); k++) {
        read_channel(reading, animation, place, k);
    }
    if (reading.clips.name.empty()) {
        reading.clips.name = optional_text(animation, place, "name");
    }
}

std::vector<std::string> names_of(const json &animations)
{
    std::vector<std::string> names;
    names.reserve(animations.size());
    for (const json &animation : animations) {
        names.push_back(optional_text(animation, Place(), "name"));
    }
    return names;
}

} // namespace

Clips read_clips(const Document &document, const Model &model, const char *name, Tally &tally)
{
    const json &animations = objects_of(document.root, "animations");
    Clips clips;
    Reading reading{document, model, clips, tally, glint_free_memory()};
    if (name != nullptr && std::strcmp(name, "none") == 0) {
        return clips;
    }
    if (name != nullptr && std::strcmp(name, "all") == 0) {
        for (std::size_t i = 0; i < animations.size(); i++) {
            read_clip(reading, i);
        }
        return clips;
    }
    if (name == nullptr && animations.empty()) {
        return clips;
    }
    if (name == nullptr && animations.size() > 1) {
        std::string first = names_of(animations)[0];
        tally.add("the first of " + std::to_string(animations.size()) +
                      " animations is shown (--animation names another, or all)",
                  "animations[0]" + (first.empty() ? "" : " " + in_quotes(first)));
    }
    read_clip(reading, name == nullptr ? 0 : find_named(names_of(animations), name, "animation"));
    return clips;
}

} // namespace glint
