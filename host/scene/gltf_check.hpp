// Validation of the raw JSON. Everything that the loader uses is checked here, and everything that
// refers to something. What is in order goes into the model, in the same pass: storage
// (gltf_check_storage.hpp), materials (gltf_material.hpp), meshes, the graph, and animations
// (gltf_animation.hpp).
#ifndef GLINT_SCENE_GLTF_CHECK_HPP
#define GLINT_SCENE_GLTF_CHECK_HPP

#include "scene/gltf_file.hpp"
#include "scene/gltf_model.hpp"

namespace glint
{

// The whole document: calls the others, and check_animations, in turn. Reads no buffer.
void check_document(const Document &document, Model &model);

// Meshes, and the primitives' attributes and indices.
void check_meshes(const json &root, Model &model);

// Nodes, scenes, cameras, and skins (gltf_skin.hpp).
void check_graph(const json &root, Model &model);

} // namespace glint

#endif
