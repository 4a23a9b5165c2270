// Checks and reads materials, and notes features that glint does not model.
#ifndef GLINT_DECODER_MATERIAL_HPP
#define GLINT_DECODER_MATERIAL_HPP

#include "decoder/texture.hpp"

namespace glint
{

// Checks the factors of every material, whether used or not.
void check_materials(const json &root);

// Writes the file's materials.
void write_materials(const json &root, Writer &writer);

} // namespace glint

#endif
