// The list of extensions that glint reads or warns about, and how it treats each.
#ifndef GLINT_SCENE_GLTF_EXTENSIONS_HPP
#define GLINT_SCENE_GLTF_EXTENSIONS_HPP

#include "scene/gltf/json.hpp"
#include "scene/gltf/tally.hpp"
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

// Tallies the extensions of a used object that glint does not model, unless they change no picture.
void survey_extensions(const json &object, Holder holder, const std::string &where, Tally &tally);

} // namespace glint

#endif
