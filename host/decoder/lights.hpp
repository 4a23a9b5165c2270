// Reads punctual lights (KHR_lights_punctual).
#ifndef GLINT_DECODER_LIGHTS_HPP
#define GLINT_DECODER_LIGHTS_HPP

#include "decoder/json.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Fills model.lights with the file's lights. A light that cannot be read has no type and a note.
void read_lights(const json &root, Model &model);

// Returns the light of nodes[index], an index into model.lights; −1: none. Notes a light that is
// not there.
int read_node_light(const json &node, const Place &place, std::size_t index, Model &model);

} // namespace glint

#endif
