// The node walk: from a scene's roots to what is drawn where, and the cameras.
#ifndef GLINT_SCENE_GLTF_WALK_HPP
#define GLINT_SCENE_GLTF_WALK_HPP

#include "scene/gltf_animation.hpp"
#include "scene/gltf_primitive.hpp"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace glint
{

// A primitive at a node (or at one of the node's instances).
struct Draw {
    const Primitive *primitive;
    int node;
    glint_mat4 to_world;
};

// What the loader works on.
struct Load {
    Document document;
    Checked checked;
    tinygltf::Model model;
    Primitives primitives;
    Clips clips;
    std::vector<Draw> draws;
    bool moves_triangles = false, moves_cameras = false; // over time, some of those that are drawn
    Tally tally;
};

// Fills load.draws, scene.cameras and the counts of what is skipped, depth first, as they are at
// `time` (seconds). `name` is a scene's name or index, or NULL for the file's default.
void walk_scene(Load &load, const char *name, double time, glint_scene &scene);

// A malloc'd copy; NULL for an empty text.
char *copy_text(const std::string &text);

} // namespace glint

#endif
