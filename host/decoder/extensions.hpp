// The list of extensions that glint reads or warns about, and how it treats each.
#ifndef GLINT_DECODER_EXTENSIONS_HPP
#define GLINT_DECODER_EXTENSIONS_HPP

#include "decoder/json.hpp"
#include "scene/scene.h"

namespace glint
{

// The kind of object that holds an extension.
enum class Holder { document, texture, material, node, primitive, scene };

// True if glint can show a file that requires the extension: it reads it, or can leave it out.
// Unknown extensions may store shapes or places in another way.
bool can_be_required(const std::string &name);

// How glint treats an extension.
glint_treatment treatment_of(const std::string &name);

// Returns a warning for each extension of an object that glint does not model, unless it changes no
// picture.
std::vector<std::string> survey_extensions(const json &object, Holder holder);

} // namespace glint

#endif
