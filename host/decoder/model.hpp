// The contents of a checked file, in tinygltf's types. After the checks the decoder reads only
// these, and what it reads of materials, textures and animations, which may be left out in part.
#ifndef GLINT_DECODER_MODEL_HPP
#define GLINT_DECODER_MODEL_HPP

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_FS
#include <nlohmann/json.hpp>

#include "decoder/writer.hpp"

#include <cstddef>
#include <fstream> // tinygltf uses it, but does not include it without its file functions
#include <map>
#include <set>
#include <string>
#include <tiny_gltf.h>
#include <utility>
#include <vector>

namespace glint
{

// A primitive's material by variant (KHR_materials_variants).
using VariantMaterials = std::map<std::size_t, int>;

// A primitive whose material depends on the variant: meshes[mesh].primitives[number].
struct MappedPrimitive {
    std::size_t mesh = 0, number = 0;
    VariantMaterials materials;
    std::string fault; // of the mapping; empty: none
};

// A packed view (meshopt.hpp): `count` elements of `stride` bytes, packed in `length` bytes at
// `offset` of a buffer.
enum class PackedMode { attributes, triangles, indices };
enum class PackedFilter { none, octahedral, quaternion, exponential };
struct PackedView {
    std::size_t view = 0, buffer = 0;
    std::uint64_t offset = 0, length = 0, stride = 0, count = 0;
    PackedMode mode = PackedMode::attributes;
    PackedFilter filter = PackedFilter::none;
};

// A primitive packed by Draco (draco.hpp), and the ids of its attributes in the packed data.
struct DracoPrimitive {
    std::size_t mesh = 0, number = 0, view = 0;
    std::vector<std::pair<std::string, std::uint32_t>> attributes;
};

// The checks (check*.cpp) fill the model: each checked object gets the values that the decoder
// writes. So it cannot write an unchecked value. An index of −1 refers to nothing; an
// accessor whose bufferView is −1 holds zeros. For a valid file tinygltf's own loader gives the
// same model. But it does not validate: it drops unreadable values, hides negative offsets, opens
// files and follows references that are out of range.
struct Model : tinygltf::Model {
    bool quantized = false;   // KHR_mesh_quantization is declared
    std::vector<int> parents; // [node]; −1: a root
    std::vector<PackedView> packed;
    bool requires_draco = false;
    std::vector<DracoPrimitive> draco;
    std::set<std::size_t> filled_accessors; // accessors that Draco fills
    mutable std::vector<Stored> bytes;      // [buffer]; without size if it is not needed
    Writer *writer = nullptr;               // that has them
    // [buffer]: why it could not be read. Only images need such a buffer.
    std::vector<std::string> buffer_faults;
    std::vector<std::string> variants; // names of the file's material variants
    std::vector<MappedPrimitive> mapped;
    std::set<std::size_t> hidden_nodes; // KHR_node_visibility: hidden, with all below
    std::vector<int> light_of;          // [node]: its punctual light; −1: none
    std::vector<std::vector<std::string>> light_notes; // [light]: warnings
    // [mesh]: the number of morph targets, the most of any primitive.
    std::vector<std::size_t> target_counts;
    // Warnings about a node, and about a primitive, {mesh, number}; given if they are shown.
    std::map<std::size_t, std::vector<std::string>> node_notes;
    std::map<std::pair<std::size_t, std::size_t>, std::vector<std::string>> notes;

    // Returns the bytes of a buffer, mapped.
    const unsigned char *buffer(std::size_t index) const
    {
        writer->map(bytes[index]);
        return bytes[index].data;
    }

    void note(std::pair<std::size_t, std::size_t> primitive, const std::string &text)
    {
        notes[primitive].push_back(text);
    }
};

// Returns the bytes of all loaded buffers.
inline std::uint64_t buffer_bytes(const Model &model)
{
    std::uint64_t sum = 0;
    for (const Stored &buffer : model.bytes) {
        sum += buffer.size;
    }
    return sum;
}

} // namespace glint

#endif
