// The node walk: which nodes a scene shows, where they stand, what they draw, and the cameras.
#ifndef GLINT_SCENE_GLTF_WALK_HPP
#define GLINT_SCENE_GLTF_WALK_HPP

#include "scene/gltf_animation.hpp"
#include "scene/gltf_material.hpp"
#include "scene/gltf_pose.hpp"
#include "scene/gltf_primitive.hpp"
#include "scene/material_override.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace glint
{

// A node that the chosen scene shows, or that only joints of its skins need.
struct Visit {
    std::size_t node;
    std::ptrdiff_t parent; // a Visit; −1: a root
    bool is_shown;         // false: only joints need it
    bool moves;            // over time, by itself or with a parent
    bool deforms;          // over time, its mesh is morphed or its skin's joints move
};

// A primitive at a node (or at one of the node's instances).
struct Draw {
    const Primitive *primitive;
    int node;
    glint_mat4 to_world; // from `shape` where there is one
    const Shape *shape;  // NULL: the primitive as the file has it
};

// What the loader works on.
struct Load {
    Document document;
    Model model;
    Primitives primitives;
    Clips clips;
    Images images;
    std::map<std::ptrdiff_t, UsedMaterial> materials; // −1: glTF's default one
    glint_material_overrides overrides = {};          // resolved
    std::vector<Skin> skins;
    std::vector<Visit> visits;            // depth first: parents come before their children
    std::vector<std::ptrdiff_t> visit_of; // [node]; −1: not visited
    Poses poses;                          // of the draws
    std::vector<Draw> draws;
    // Over time, some of those that are shown.
    bool moves_triangles = false, moves_cameras = false, moves_lights = false;
    Tally tally;
};

// Fills load.visits, and what moves. `name` is a scene's name or index, or NULL for the file's
// default.
void choose_nodes(Load &load, const char *name);

// Where a chosen node stands at `time` (seconds), given where those before it do.
glint_mat4 place_node(const Load &load, std::size_t visit, double time,
                      const std::vector<glint_mat4> &placed);

PoseSource pose_source(const Load &load);

// The places of a node's instances, relative to the node; empty where it is not instanced. Refuses
// more than fit, where `drawn` primitives are drawn already. The node must have a mesh.
std::vector<glint_mat4> instances_of(const Load &load, std::size_t node, std::size_t drawn);

// Fills load.draws, scene.cameras, scene.lights and the counts of what is skipped, as they are at
// `time`.
void walk_scene(Load &load, double time, glint_scene &scene);

} // namespace glint

#endif
