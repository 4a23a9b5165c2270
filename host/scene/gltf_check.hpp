// Validates the raw JSON: every value that the loader uses, and every reference. The same pass
// copies valid values to the model: storage (gltf_check_storage.hpp), materials
// (gltf_material.hpp), meshes, the graph, and animations (gltf_animation.hpp).
#ifndef GLINT_SCENE_GLTF_CHECK_HPP
#define GLINT_SCENE_GLTF_CHECK_HPP

#include "scene/gltf_file.hpp"
#include "scene/gltf_model.hpp"

namespace glint
{

// Checks the whole document: calls the other checks and check_animations in turn. Reads no buffer.
void check_document(const Document &document, Model &model);

// Checks meshes, and their primitives' attributes and indices.
void check_meshes(const json &root, Model &model);

// Checks that normals, joints, weights and targets have as many elements as the positions. Leaves out
// texture coordinates, tangents and colours that cannot be read, with a note. Call it after Draco's
// data is decoded, which has counts of its own.
void settle_attributes(Model &model);

// Checks nodes, scenes, cameras, and skins (gltf_skin.hpp).
void check_graph(const json &root, Model &model);

} // namespace glint

#endif
