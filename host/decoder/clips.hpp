// Reads the animations of a glTF file.
#ifndef GLINT_DECODER_CLIPS_HPP
#define GLINT_DECODER_CLIPS_HPP

#include "decoder/arrays.hpp"
#include "decoder/file.hpp"

namespace glint
{

// Writes the animations, and the channels that glint can follow. Leaves out other channels, with a
// note of the animation. Does not read the keys.
void write_animations(const json &root, const Model &model, Arrays &arrays, Writer &writer);

} // namespace glint

#endif
