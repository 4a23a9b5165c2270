// Validation of the raw JSON, before tinygltf sees any of it. tinygltf is no validator: it drops
// what it cannot read, hides negative offsets and follows what is out of range. Everything that the
// loader uses is checked here, and everything that refers to something.
#ifndef GLINT_SCENE_GLTF_CHECK_HPP
#define GLINT_SCENE_GLTF_CHECK_HPP

#include "scene/gltf_file.hpp"

#include <vector>

namespace glint
{

// What was checked, and is wanted again.
struct Checked {
    bool quantized = false;   // KHR_mesh_quantization is declared
    std::vector<int> parents; // of each node; −1: a root
};

// The whole document: calls the others, and check_animations, in turn. Reads no buffer.
void check_document(const Document &document, Checked &checked);

// Buffers, views and accessors.
void check_storage(const Document &document);

// Meshes, and the primitives' attributes and indices.
void check_meshes(const json &root, const Checked &checked);

// Nodes, scenes, cameras and skins.
void check_graph(const json &root, Checked &checked);

// A vertex attribute, index or instance attribute must be of one of these.
struct Format {
    const char *type;           // "VEC3"
    bool plain_float;           // 5126
    bool normalized_ints;       // normalised signed byte or short
    bool quantized;             // whatever KHR_mesh_quantization lets positions be
    bool unsigned_ints = false; // normalised unsigned byte or short
};
void check_format(const json &accessor, const Place &place, const Format &format);

std::uint64_t component_size(std::uint64_t component_type);

} // namespace glint

#endif
