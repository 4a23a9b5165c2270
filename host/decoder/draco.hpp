// KHR_draco_mesh_compression: decodes primitives whose attributes and indices are packed together.
#ifndef GLINT_DECODER_DRACO_HPP
#define GLINT_DECODER_DRACO_HPP

#include "decoder/json.hpp"
#include "decoder/limits.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Checks the extension of the primitive last added to the model, and adds it to model.draco.
// Ignores it if it only repeats the accessors' data: the file does not require it, and every
// accessor has its data.
void check_draco(const json &source, const Place &place, Model &model);

// Decodes model.draco, each view once. The primitives then refer to new
// accessors, with the counts of Draco's data; a note says where the file's accessors have others.
// Refuses damaged data. Throws a shortage if memory is short.
void decode_draco(Limits &limits, Writer &writer, Model &model);

} // namespace glint

#endif
