// EXT_meshopt_compression and KHR_meshopt_compression: views whose bytes are packed, and buffers
// that hold no bytes.
#ifndef GLINT_SCENE_GLTF_MESHOPT_HPP
#define GLINT_SCENE_GLTF_MESHOPT_HPP

#include "scene/gltf_json.hpp"
#include "scene/gltf_model.hpp"

namespace glint
{

// Whether the buffer says that it stands in for packed data, so that nothing in it is read.
bool is_fallback(const json &buffer, const Place &place);

// Checks the extension of bufferViews[index], whose own members were checked, and adds it to
// model.packed. False where there is none.
bool check_packed_view(const json &root, std::size_t index, Model &model);

// Unpacks model.packed, each into a buffer of its own that its view then refers to. The buffers
// were read. Refuses damaged data; throws a shortage where the machine has not the memory.
void unpack_views(Model &model);

} // namespace glint

#endif
