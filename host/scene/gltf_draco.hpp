// KHR_draco_mesh_compression: primitives whose attributes and indices are packed together.
#ifndef GLINT_SCENE_GLTF_DRACO_HPP
#define GLINT_SCENE_GLTF_DRACO_HPP

#include "scene/gltf_json.hpp"
#include "scene/gltf_model.hpp"

namespace glint
{

// Checks the extension of the primitive that was added to the model last, and adds it to
// model.draco. It is passed over where it repeats what the accessors hold: the file does not
// require it, and every accessor has its data.
void check_draco(const json &source, const Place &place, Model &model);

// Decodes model.draco in the decoder's process, each view once. The primitives then refer to new
// accessors. Refuses damaged data, and data that is not what the accessors say; throws a shortage
// where the machine has not the memory.
void decode_draco(Model &model);

} // namespace glint

#endif
