// Reads the factors of materials: all but their textures.
#ifndef GLINT_DECODER_FACTORS_HPP
#define GLINT_DECODER_FACTORS_HPP

#include "decoder/texture.hpp"

namespace glint
{

constexpr const char *specular_glossiness = "KHR_materials_pbrSpecularGlossiness";

// Reads a material without its textures. A number out of its range counts as the nearest within,
// and is noted. Refuses what is no number.
glint_material read_factors_at(const json &object, const Place &place, std::vector<Note> &notes);

} // namespace glint

#endif
