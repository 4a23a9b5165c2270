// Opens checked accessors as arrays.
#ifndef GLINT_SCENE_GLTF_ACCESSOR_HPP
#define GLINT_SCENE_GLTF_ACCESSOR_HPP

#include "scene/gltf/array.h"
#include "scene/gltf/model.hpp"

namespace glint
{

// Returns the bytes of a view whose buffer is loaded.
const unsigned char *view_data(const Model &model, std::size_t index);

// Returns the array of accessors[index], which reads the model's bytes. Refuses sparse indices that
// do not ascend or are out of range.
glint_array open_array(const Model &model, std::size_t index);

} // namespace glint

#endif
