// Punctual lights (KHR_lights_punctual).
#ifndef GLINT_SCENE_GLTF_LIGHTS_HPP
#define GLINT_SCENE_GLTF_LIGHTS_HPP

#include "scene/gltf_json.hpp"
#include "scene/gltf_model.hpp"
#include "scene/gltf_walk.hpp"

namespace glint
{

// Fills model.lights with the file's lights.
void check_lights(const json &root, Model &model);

// The light of a node: an index into model.lights; −1: none.
int check_node_light(const json &node, const Place &place, const Model &model);

// Makes room in the scene for the lights of all nodes that it shows.
void allocate_lights(const Load &load, glint_scene &scene);

// Adds a node's light, where the node stands. One that shines nowhere is left out, with a warning.
void add_light(Load &load, std::size_t node, const glint_mat4 &to_world, glint_scene &scene);

} // namespace glint

#endif
