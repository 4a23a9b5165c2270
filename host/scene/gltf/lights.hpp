// Reads and places punctual lights (KHR_lights_punctual).
#ifndef GLINT_SCENE_GLTF_LIGHTS_HPP
#define GLINT_SCENE_GLTF_LIGHTS_HPP

#include "scene/gltf/json.hpp"
#include "scene/gltf/model.hpp"
#include "scene/gltf/walk.hpp"

namespace glint
{

// Fills model.lights with the file's lights. A light that cannot be read has no type and a note.
void read_lights(const json &root, Model &model);

// Returns the light of nodes[index], an index into model.lights; −1: none. Notes a light that is
// not there.
int read_node_light(const json &node, const Place &place, std::size_t index, Model &model);

// Allocates the scene's lights, enough for all nodes that it shows.
void allocate_lights(const Load &load, glint_scene &scene);

// Adds the light of a node at the node's place. Leaves out, with a warning, a light that shines
// nowhere or cannot be read.
void add_light(Load &load, std::size_t node, const glint_mat4 &to_world, glint_scene &scene);

} // namespace glint

#endif
