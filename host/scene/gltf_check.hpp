// Validation of the raw JSON. Everything that the loader uses is checked here, and everything that
// refers to something. What is in order goes into the model, in the same pass.
#ifndef GLINT_SCENE_GLTF_CHECK_HPP
#define GLINT_SCENE_GLTF_CHECK_HPP

#include "scene/gltf_file.hpp"
#include "scene/gltf_model.hpp"

namespace glint
{

// The whole document: calls the others, and check_animations, in turn. Reads no buffer.
void check_document(const Document &document, Model &model);

// Buffers, views and accessors.
void check_storage(const Document &document, Model &model);

// Meshes, and the primitives' attributes and indices.
void check_meshes(const json &root, Model &model);

// Nodes, scenes, cameras and skins.
void check_graph(const json &root, Model &model);

// A vertex attribute, index or instance attribute must be of one of these.
struct Format {
    int type;                   // TINYGLTF_TYPE_VEC3
    bool plain_float;           // 5126
    bool normalized_ints;       // normalised signed byte or short
    bool quantized;             // whatever KHR_mesh_quantization lets positions be
    bool unsigned_ints = false; // normalised unsigned byte or short
};
void check_format(const tinygltf::Accessor &accessor, const Place &place, const Format &format);

// "VEC3"
const char *type_name(int code);

std::uint64_t component_size(std::uint64_t component_type);

} // namespace glint

#endif
