// Validation of the raw JSON: buffers, views and accessors, which the other checks refer to.
#ifndef GLINT_SCENE_GLTF_CHECK_STORAGE_HPP
#define GLINT_SCENE_GLTF_CHECK_STORAGE_HPP

#include "scene/gltf_file.hpp"
#include "scene/gltf_model.hpp"

namespace glint
{

// Fills the model's views and accessors. Reads no buffer.
void check_storage(const Document &document, Model &model);

// Refuses many zeros: accessors without data that nothing fills. The meshes were checked.
void check_zeros(const Model &model);

// A vertex attribute, index or instance attribute must be of one of these.
struct Format {
    int type;                   // TINYGLTF_TYPE_VEC3
    bool plain_float;           // 5126
    bool normalized_ints;       // normalised signed byte or short
    bool quantized;             // whatever KHR_mesh_quantization lets positions be
    bool unsigned_ints = false; // normalised unsigned byte or short
};
void check_format(const tinygltf::Accessor &accessor, const Place &place, const Format &format);

} // namespace glint

#endif
