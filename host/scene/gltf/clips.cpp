// Reads animations of a glTF file. See clips.hpp.
#include "scene/gltf/clips.hpp"

#include "base/free_memory.h"
#include "scene/gltf/accessor.hpp"
#include "scene/gltf/check_storage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace glint
{

namespace
{

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

// The input and output of reading clips.
struct Reading {
    const Document &document;
    const Model &model;
    Clips &clips;
    Tally &tally;
    std::uint64_t left; // bytes of memory that further curves may take
};

// What a channel moves.
struct Target {
    std::size_t node;
    Property property;
    std::size_t components; // numbers of a value
};

// A channel's sampler.
struct Sampler {
    const json &source;
    Place place;
    glint_interpolation interpolation;
    std::size_t input, output; // accessors

    // Returns the number of values per key: 1, or 3 with tangents.
    std::size_t values_a_key() const
    {
        return interpolation == GLINT_INTERPOLATION_CUBIC ? 3 : 1;
    }
};

// ---- Samplers -----------------------------------------------------------------------------------

std::size_t accessor_of(const json &sampler, const Place &place, const char *key,
                        const Model &model)
{
    const std::ptrdiff_t index =
        optional_index(sampler, place, key, model.accessors.size(), "accessor");
    if (index < 0) {
        refuse(place / key, "missing (glTF 2.0 requires it)");
    }
    return static_cast<std::size_t>(index);
}

Sampler find_sampler(const Reading &reading, const json &animation, const Place &place,
                     const json &channel, const Place &channel_place)
{
    const json &samplers = array_at(animation, place, "samplers");
    const std::ptrdiff_t index =
        optional_index(channel, channel_place, "sampler", samplers.size(), "sampler");
    if (index < 0) {
        refuse(channel_place / "sampler", "missing (glTF 2.0 requires it)");
    }
    const auto number = static_cast<std::size_t>(index);
    const Place at = (place / "samplers")[number];
    const json &source = samplers[number];
    expect_object(source, at);
    return {source, at, interpolation_of(source, at),
            accessor_of(source, at, "input", reading.model),
            accessor_of(source, at, "output", reading.model)};
}

// Checks the accessors' kinds and lengths.
void check_accessors(const Sampler &sampler, const Target &target, const Model &model)
{
    const tinygltf::Accessor &input = model.accessors[sampler.input];
    const tinygltf::Accessor &output = model.accessors[sampler.output];
    check_format(input, sampler.place / "input", {TINYGLTF_TYPE_SCALAR, true, false, false});
    const bool is_vector = target.property == translation || target.property == scale;
    const int type = is_vector                     ? TINYGLTF_TYPE_VEC3
                     : target.property == rotation ? TINYGLTF_TYPE_VEC4
                                                   : TINYGLTF_TYPE_SCALAR;
    check_format(output, sampler.place / "output", {type, true, !is_vector, false, !is_vector});
    const std::uint64_t each =
        sampler.values_a_key() * (target.property == weights ? target.components : 1);
    const std::uint64_t values = output.count, keys = input.count;
    if (values % each != 0 || values / each != keys) { // a product could overflow
        refuse(sampler.place / "output",
               counted(values, "value") + " for " + counted(keys, "key") +
                   (target.property == weights ? " of " + counted(target.components, "morph target")
                                               : "") +
                   (sampler.values_a_key() == 3 ? ", which have three each" : ""));
    }
}

std::vector<double> read_times(const glint_array &array, const Place &place, Tally &tally)
{
    std::vector<double> times(array.count);
    bool repeats = false;
    for (std::size_t i = 0; i < times.size(); i++) {
        glint_array_numbers(&array, i, 1, &times[i]);
        if (!std::isfinite(times[i]) || (i > 0 && times[i] < times[i - 1])) {
            refuse(place, "the times of its keys must be finite and ascend");
        }
        repeats = repeats || (i > 0 && times[i] == times[i - 1]);
    }
    if (repeats) {
        tally.add("several keys have one time (the value jumps there)", place.text());
    }
    return times;
}

std::vector<double> read_values(const glint_array &array, std::size_t components, std::size_t each,
                                const Place &place)
{
    std::vector<double> values(array.count * components);
    for (std::size_t i = 0; i < array.count; i++) {
        double *value = values.data() + i * components;
        glint_array_numbers(&array, i, components, value);
        double squares = 0;
        for (std::size_t k = 0; k < components; k++) {
            squares += value[k] * value[k];
        }
        bool is_tangent = each == 3 && i % 3 != 1;
        if (!std::isfinite(squares)) {
            refuse(place, "a value is not finite");
        }
        if (components == 4 && !is_tangent && !(squares > 0)) {
            refuse(place, "a value is no rotation (a quaternion is not 0)");
        }
    }
    return values;
}

// ---- Channels -----------------------------------------------------------------------------------

// Returns the number of morph targets of a node; 0 if the node has none.
std::size_t targets_of(const Model &model, std::size_t node)
{
    const int mesh = model.nodes[node].mesh;
    return mesh < 0 ? 0 : model.target_counts[static_cast<std::size_t>(mesh)];
}

// Finds what a channel moves. Refuses a target that glint does not move.
Target find_target(const Model &model, const json &channel, const Place &place)
{
    const json &target = object_at(channel, place, "target");
    const std::size_t property = property_of(optional_text(target, place / "target", "path"));
    const std::ptrdiff_t node =
        optional_index(target, place / "target", "node", model.nodes.size(), "node");
    if (property == paths.size() || node < 0) {
        refuse(place, "only translation, rotation, scale and weights of nodes are animated");
    }
    const auto index = static_cast<std::size_t>(node);
    const std::size_t targets = targets_of(model, index);
    if (property == weights && targets == 0) {
        refuse(place, "the node has no morph targets");
    }
    if (property != weights && !model.nodes[index].matrix.empty()) {
        refuse(place, "the node has a matrix, which cannot be animated");
    }
    return {index, static_cast<Property>(property),
            property == weights    ? targets
            : property == rotation ? 4
                                   : 3};
}

// Counts a curve's memory. Many channels may share a sampler, but each has its own curve.
void take_memory(Reading &reading, std::uint64_t bytes)
{
    if (bytes > reading.left) {
        throw shortage("its animations take more memory than is free (leave some out: "
                       "--animation)");
    }
    reading.left -= bytes;
}

// Reads a channel. Refuses one that cannot be read.
void read_channel(Reading &reading, const json &animation, const Place &place, std::size_t number)
{
    const json &channel = animation["channels"][number];
    const Place at = (place / "channels")[number];
    const Model &model = reading.model;
    expect_object(channel, at);
    const Target target = find_target(model, channel, at);
    const Sampler sampler = find_sampler(reading, animation, place, channel, at);
    check_accessors(sampler, target, model);
    const std::size_t of_output = target.property == weights ? 1 : target.components;
    take_memory(reading, (model.accessors[sampler.input].count +
                          model.accessors[sampler.output].count * of_output) *
                             sizeof(double));
    Curve curve;
    curve.is_rotation = target.property == rotation;
    curve.components = target.components;
    curve.interpolation = sampler.interpolation;
    curve.times =
        read_times(open_array(model, sampler.input), sampler.place / "input", reading.tally);
    curve.values = read_values(open_array(model, sampler.output), of_output, sampler.values_a_key(),
                               sampler.place / "output");
    reading.clips.duration = std::max(reading.clips.duration, curve.times.back());
    reading.clips.nodes[target.node].of[target.property] = std::move(curve);
}

// Leaves out channels that cannot be read.
void read_channels(Reading &reading, const json &animation, const Place &place)
{
    const json &channels = array_at(animation, place, "channels");
    for (std::size_t k = 0; k < channels.size(); k++) {
        try {
            read_channel(reading, animation, place, k);
        } catch (const refusal &fault) {
            reading.tally.add(fault.cause() + "; the channel is left out", fault.where());
        }
    }
}

void read_clip(Reading &reading, std::size_t index)
{
    const json &animation = objects_of(reading.document.root, "animations")[index];
    Place place = (Place() / "animations")[index];
    try {
        read_channels(reading, animation, place);
    } catch (const refusal &fault) {
        reading.tally.add(fault.cause() + "; the animation is left out", fault.where());
    }
    if (reading.clips.name.empty()) {
        reading.clips.name = name_of(animation);
    }
}

std::vector<std::string> names_of(const json &animations)
{
    std::vector<std::string> names;
    names.reserve(animations.size());
    for (const json &animation : animations) {
        names.push_back(name_of(animation));
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
