// KHR_materials_variants: chooses one of several sets of materials in a file.
#ifndef GLINT_DECODER_VARIANTS_HPP
#define GLINT_DECODER_VARIANTS_HPP

#include "decoder/json.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Reads the variants' names into model.variants; none if the list cannot be read.
void read_variants(const json &root, Model &model);

// Returns a primitive's materials by variant, without its mesh and number. Its fault says why some
// could not be read.
MappedPrimitive read_variant_mappings(const json &root, const json &primitive, const Place &place,
                                      const Model &model);

} // namespace glint

#endif
