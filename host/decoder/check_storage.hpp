// Validates buffers, views and accessors, to which the other checks refer.
#ifndef GLINT_DECODER_CHECK_STORAGE_HPP
#define GLINT_DECODER_CHECK_STORAGE_HPP

#include "decoder/json.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Fills the model's views and accessors. Reads no buffer.
void check_storage(const json &root, Model &model);

// Refuses too many zeros: accessors without data that no extension fills. Call it after the meshes
// are checked.
void check_zeros(const Model &model);

// The allowed formats of a vertex attribute, index or instance attribute.
struct Format {
    int type;                   // for example TINYGLTF_TYPE_VEC3
    bool plain_float;           // float, 5126
    bool normalized_ints;       // normalised signed byte or short
    bool quantized;             // any format that KHR_mesh_quantization allows for positions
    bool unsigned_ints = false; // normalised unsigned byte or short
};
bool has_format(const tinygltf::Accessor &accessor, const Format &format);
void check_format(const tinygltf::Accessor &accessor, const Place &place, const Format &format);

} // namespace glint

#endif
