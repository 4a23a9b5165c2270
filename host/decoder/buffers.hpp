// Reads the buffers that the scene needs.
#ifndef GLINT_DECODER_BUFFERS_HPP
#define GLINT_DECODER_BUFFERS_HPP

#include "decoder/file.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Fills model.bytes. Refuses if a buffer that accessors or packed data need cannot be read. A
// buffer that only images need may be missing: then model.buffer_faults says why. Buffers that
// nothing needs stay empty.
void read_buffers(SceneFile &input, Writer &writer, Model &model);

} // namespace glint

#endif
