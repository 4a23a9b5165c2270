// Reads animations of a glTF file. See clips.hpp.
#include "decoder/clips.hpp"

#include "decoder/check_storage.hpp"
#include "scene/gltf/curve.h"

#include <algorithm>
#include <array>

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

// What a channel moves.
struct Target {
    std::size_t node;
    glint_property property;
    std::size_t components; // numbers of a value
};

// A channel's sampler.
struct Sampler {
    std::size_t number; // in the animation
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

Sampler find_sampler(const Model &model, const json &animation, const Place &place,
                     const json &channel, const Place &channel_place)
{
    const json &samplers = array_at(animation, place, "samplers");
    const std::size_t number =
        index_at(channel, channel_place, "sampler", samplers.size(), "sampler");
    const std::size_t accessors = model.accessors.size();
    const Place at = (place / "samplers")[number];
    const json &source = samplers[number];
    expect_object(source, at);
    return {number, at, interpolation_of(source, at),
            index_at(source, at, "input", accessors, "accessor"),
            index_at(source, at, "output", accessors, "accessor")};
}

// Checks the accessors' kinds and lengths.
void check_accessors(const Sampler &sampler, const Target &target, const Model &model)
{
    const tinygltf::Accessor &input = model.accessors[sampler.input];
    const tinygltf::Accessor &output = model.accessors[sampler.output];
    check_format(input, sampler.place / "input", {TINYGLTF_TYPE_SCALAR, true, false, false});
    const bool is_vector =
        target.property == GLINT_PROPERTY_TRANSLATION || target.property == GLINT_PROPERTY_SCALE;
    const int type = is_vector                                    ? TINYGLTF_TYPE_VEC3
                     : target.property == GLINT_PROPERTY_ROTATION ? TINYGLTF_TYPE_VEC4
                                                                  : TINYGLTF_TYPE_SCALAR;
    check_format(output, sampler.place / "output", {type, true, !is_vector, false, !is_vector});
    const std::uint64_t each = sampler.values_a_key() *
                               (target.property == GLINT_PROPERTY_WEIGHTS ? target.components : 1);
    const std::uint64_t values = output.count, keys = input.count;
    if (values % each != 0 || values / each != keys) { // a product could overflow
        refuse(sampler.place / "output",
               counted(values, "value") + " for " + counted(keys, "key") +
                   (target.property == GLINT_PROPERTY_WEIGHTS
                        ? " of " + counted(target.components, "morph target")
                        : "") +
                   (sampler.values_a_key() == 3 ? ", which have three each" : ""));
    }
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
    if (property == GLINT_PROPERTY_WEIGHTS && targets == 0) {
        refuse(place, "the node has no morph targets");
    }
    if (property != GLINT_PROPERTY_WEIGHTS && !model.nodes[index].matrix.empty()) {
        refuse(place, "the node has a matrix, which cannot be animated");
    }
    return {index, static_cast<glint_property>(property),
            property == GLINT_PROPERTY_WEIGHTS    ? targets
            : property == GLINT_PROPERTY_ROTATION ? 4
                                                  : 3};
}

// Reads a channel. Refuses one that cannot be read.
glint_document_channel read_channel(const Model &model, const json &animation, const Place &place,
                                    std::size_t number, Arrays &arrays)
{
    const json &channel = animation["channels"][number];
    const Place at = (place / "channels")[number];
    expect_object(channel, at);
    const Target target = find_target(model, channel, at);
    const Sampler sampler = find_sampler(model, animation, place, channel, at);
    check_accessors(sampler, target, model);
    glint_document_channel row = {};
    row.node = static_cast<std::int32_t>(target.node);
    row.property = target.property;
    row.interpolation = sampler.interpolation;
    row.input = arrays.of(static_cast<std::ptrdiff_t>(sampler.input));
    row.output = arrays.of(static_cast<std::ptrdiff_t>(sampler.output));
    row.sampler = static_cast<std::int32_t>(sampler.number);
    return row;
}

void add_note(const refusal &fault, const char *lost, Writer &writer)
{
    writer.notes.push_back({writer.text(fault.where()), writer.text(fault.cause() + lost)});
}

// Leaves out channels that cannot be read.
void read_channels(const Model &model, const json &animation, const Place &place, Arrays &arrays,
                   Writer &writer)
{
    const json &channels = array_at(animation, place, "channels");
    for (std::size_t k = 0; k < channels.size(); k++) {
        try {
            writer.channels.push_back(read_channel(model, animation, place, k, arrays));
        } catch (const refusal &fault) {
            add_note(fault, "; the channel is left out", writer);
        }
    }
}

} // namespace

void write_animations(const json &root, const Model &model, Arrays &arrays, Writer &writer)
{
    const json &animations = objects_of(root, "animations");
    for (std::size_t i = 0; i < animations.size(); i++) {
        glint_document_animation row = {};
        row.name = writer.text(name_of(animations[i]));
        row.channels.first = static_cast<std::uint32_t>(writer.channels.size());
        row.notes.first = static_cast<std::uint32_t>(writer.notes.size());
        try {
            read_channels(model, animations[i], (Place() / "animations")[i], arrays, writer);
        } catch (const refusal &fault) {
            add_note(fault, "; the animation is left out", writer);
        }
        row.channels.count =
            static_cast<std::uint32_t>(writer.channels.size()) - row.channels.first;
        row.notes.count = static_cast<std::uint32_t>(writer.notes.size()) - row.notes.first;
        writer.animations.push_back(row);
    }
}

} // namespace glint
