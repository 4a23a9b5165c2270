// What a checked document holds, in tinygltf's types: what is read after the checks.
#ifndef GLINT_SCENE_GLTF_MODEL_HPP
#define GLINT_SCENE_GLTF_MODEL_HPP

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#define TINYGLTF_NO_FS
#include <nlohmann/json.hpp>

#include <cstddef>
#include <fstream> // which tinygltf leaves out without its file functions, and uses all the same
#include <map>
#include <set>
#include <string>
#include <tiny_gltf.h>
#include <vector>

namespace glint
{

// Materials by the variant in which a primitive has them (KHR_materials_variants).
using VariantMaterials = std::map<std::size_t, int>;

// A primitive whose material depends on the variant: meshes[mesh].primitives[number].
struct MappedPrimitive {
    std::size_t mesh, number;
    VariantMaterials materials;
};

// A view whose bytes are packed (gltf_meshopt.hpp): `count` elements of `stride` bytes, from
// `length` bytes at `offset` of a buffer.
enum class PackedMode { attributes, triangles, indices };
enum class PackedFilter { none, octahedral, quaternion, exponential };
struct PackedView {
    std::size_t view = 0, buffer = 0;
    std::uint64_t offset = 0, length = 0, stride = 0, count = 0;
    PackedMode mode = PackedMode::attributes;
    PackedFilter filter = PackedFilter::none;
};

// A primitive that Draco packed (gltf_draco.hpp), and the ids of its attributes there.
struct DracoPrimitive {
    std::size_t mesh = 0, number = 0, view = 0;
    std::vector<std::pair<std::string, std::uint32_t>> attributes;
};

// The checks fill it, each object where it is checked (gltf_check*.cpp), with what the loader reads
// of it. So no value can be read that nobody has checked. An index of −1 refers to nothing; an
// accessor whose bufferView is −1 holds zeros. Where the file is in order tinygltf's own loader
// gives the same, but it is no validator: it drops what it cannot read, hides negative offsets,
// opens files and follows what is out of range.
struct Model : tinygltf::Model {
    bool quantized = false;   // KHR_mesh_quantization is declared
    std::vector<int> parents; // of each node; −1: a root
    std::vector<PackedView> packed;
    bool requires_draco = false;
    std::vector<DracoPrimitive> draco;
    std::set<std::size_t> filled_accessors; // by Draco
    std::vector<bool> is_read;         // of each buffer; false: a placeholder for what views unpack
    std::vector<std::string> variants; // the names of the file's variants of materials
    std::ptrdiff_t variant = -1;       // the chosen one; −1: the plain materials
    std::vector<MappedPrimitive> mapped;
    std::vector<int> light_of;              // of each node, its punctual light; −1: none
    std::vector<std::size_t> target_counts; // of each mesh's morph targets: the most of a primitive
};

// Bytes of all buffers that are there.
inline std::uint64_t buffer_bytes(const Model &model)
{
    std::uint64_t sum = 0;
    for (const tinygltf::Buffer &buffer : model.buffers) {
        sum += buffer.data.size();
    }
    return sum;
}

} // namespace glint

#endif
