// EXT_meshopt_compression and KHR_meshopt_compression: unpacks views, and finds fallback buffers,
// which hold no bytes.
#ifndef GLINT_DECODER_MESHOPT_HPP
#define GLINT_DECODER_MESHOPT_HPP

#include "decoder/json.hpp"
#include "decoder/limits.hpp"
#include "decoder/model.hpp"

namespace glint
{

// True if the buffer says that it stands in for packed data; its content is not read.
bool is_fallback(const json &buffer, const Place &place);

// Checks the extension of bufferViews[index] and adds it to model.packed. The view's own members
// are already checked. Does nothing if the view has no such extension.
void check_packed_view(const json &root, std::size_t index, Model &model);

// Unpacks each of model.packed into a buffer of its own, to which its view then refers. The buffers
// must be loaded. Refuses damaged data; throws a shortage if memory is short.
void unpack_views(const Limits &limits, Writer &writer, Model &model);

} // namespace glint

#endif
