// Reads the buffers that the scene needs.
#ifndef GLINT_SCENE_GLTF_BUFFERS_HPP
#define GLINT_SCENE_GLTF_BUFFERS_HPP

#include "scene/gltf/file.hpp"
#include "scene/gltf/model.hpp"

namespace glint
{

// Fills model.buffers. Refuses if a buffer that accessors or packed data need cannot be read. A
// buffer that only images need may be missing: then model.buffer_faults says why. Buffers that
// nothing needs stay empty.
void read_buffers(Document &document, Model &model);

} // namespace glint

#endif
