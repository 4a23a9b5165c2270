// Writes a checked model as a document.
#ifndef GLINT_DECODER_COMPOSE_HPP
#define GLINT_DECODER_COMPOSE_HPP

#include "decoder/file.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Writes all tables. The model's buffers are read, unpacked and decoded.
void compose(const SceneFile &input, const Model &model, Writer &writer);

} // namespace glint

#endif
