// Checks skins.
#ifndef GLINT_DECODER_SKIN_HPP
#define GLINT_DECODER_SKIN_HPP

#include "decoder/json.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Checks skins and fills model.skins. Refuses joints that are no nodes, and matrices that are too
// few or of the wrong kind.
void check_skins(const json &root, Model &model);

// Refuses JOINTS_n and WEIGHTS_n of the wrong kind, and either without the other.
void check_influences(const json &attributes, const Place &place, const Model &model);

} // namespace glint

#endif
