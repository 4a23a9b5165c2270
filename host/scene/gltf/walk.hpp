// Walks the nodes: finds the nodes that a scene shows, their places, their primitives, and the
// cameras.
#ifndef GLINT_SCENE_GLTF_WALK_HPP
#define GLINT_SCENE_GLTF_WALK_HPP

#include "scene/gltf/clips.hpp"
#include "scene/gltf/material.hpp"
#include "scene/gltf/pose.hpp"
#include "scene/gltf/primitive.hpp"
#include "scene/material/material_override.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace glint
{

// A node of the chosen scene, or a node of a tree that only joints of its skins need.
struct Visit {
    std::size_t node;
    std::ptrdiff_t parent; // index of the parent's Visit; −1: a root
    bool is_shown;         // false: hidden, or only joints need the node
    bool moves;            // over time, by itself or with an ancestor
    bool deforms;          // over time: its mesh is morphed, or its skin's joints move
};

// A primitive drawn at a node or at one of the node's instances.
struct Draw {
    const glint_primitive *primitive;
    int node;
    glint_mat4 to_world;      // from the coordinates of `shape`, if there is one
    const glint_shape *shape; // NULL: the primitive as the file has it
};

// The loader's data.
struct Load {
    Document document;
    Model model;
    Primitives primitives;
    Clips clips;
    Images images;
    std::map<std::ptrdiff_t, UsedMaterial> materials; // −1: glTF's default material
    glint_material_overrides overrides = {};          // resolved
    std::vector<Skin> skins;
    std::vector<Visit> visits;            // depth first: parents stand before their children
    std::vector<std::ptrdiff_t> visit_of; // [node]; −1: not visited
    Poses poses;                          // poses of the draws
    std::vector<Draw> draws;
    bool hides_any = false; // some mesh is hidden, or has a scale of 0 at the walk's time
    // True if some shown triangles, cameras or lights move over time.
    bool moves_triangles = false, moves_cameras = false, moves_lights = false;
    Tally tally;
};

// Fills load.visits and the moves_ members. `name` is a scene's name or index; NULL: the file's
// default.
void choose_nodes(Load &load, const char *name);

// Returns the matrix of a chosen node at `time` (seconds). `placed` holds the matrices of the nodes
// before it.
glint_mat4 place_node(const Load &load, std::size_t visit, double time,
                      const std::vector<glint_mat4> &placed);

PoseSource pose_source(const Load &load);

// Returns the places of a node's instances, relative to the node; empty if it is not instanced.
// Refuses too many instances; `drawn` primitives are already drawn. The node must have a mesh.
std::vector<glint_mat4> instances_of(const Load &load, std::size_t node, std::size_t drawn);

// Fills load.draws, scene.cameras, scene.lights and the skipped counts, for `time`.
void walk_scene(Load &load, double time, glint_scene &scene);

} // namespace glint

#endif
