// What glint makes of each extension: the one list of those that it reads, or has a word for.
#ifndef GLINT_SCENE_GLTF_EXTENSIONS_HPP
#define GLINT_SCENE_GLTF_EXTENSIONS_HPP

#include "scene/gltf_json.hpp"
#include "scene/gltf_tally.hpp"
#include "scene/scene.h"

namespace glint
{

// The kind of object that an extension stands in.
enum class Holder { document, texture, material, node, primitive };

// Whether a file that requires the extension can be shown.
bool can_be_required(const std::string &name);

// What is made of an extension.
glint_treatment treatment_of(const std::string &name);

// Adds those of a used object's extensions that are not modelled to the tally.
void survey_extensions(const json &object, Holder holder, const std::string &where, Tally &tally);

} // namespace glint

#endif
