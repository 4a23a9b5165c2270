// Validates the raw JSON: storage (check_storage.hpp), meshes, the graph, and the factors of
// materials (material.hpp). The same pass copies valid values to the model. Parts that may be
// left out (json.hpp has the rule) are checked when they are read: textures and animations.
#ifndef GLINT_DECODER_CHECK_HPP
#define GLINT_DECODER_CHECK_HPP

#include "decoder/file.hpp"
#include "decoder/model.hpp"

namespace glint
{

// Checks all that shapes and places need: calls the other checks in turn. Reads no buffer.
void check_document(const SceneFile &input, Model &model);

// Checks meshes, and their primitives' attributes and indices.
void check_meshes(const json &root, Model &model);

// Checks that normals, joints, weights and targets have as many elements as the positions. Leaves
// out texture coordinates, tangents and colours that cannot be read, with a note. Call it after
// Draco's data is decoded, which has counts of its own.
void settle_attributes(Model &model);

// Checks nodes, scenes, cameras, and skins (skin.hpp).
void check_graph(const json &root, Model &model);

} // namespace glint

#endif
