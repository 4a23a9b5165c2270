// Poses: what morph weights and joints make of each node's mesh at one time.
#ifndef GLINT_SCENE_GLTF_POSE_HPP
#define GLINT_SCENE_GLTF_POSE_HPP

#include "scene/gltf_animation.hpp"
#include "scene/gltf_primitive.hpp"
#include "scene/gltf_shape.hpp"

#include <map>
#include <tuple>
#include <vector>

namespace glint
{

// A skin's joints at one time.
struct Bones {
    std::vector<glint_mat4> matrices; // from the mesh as bound to the world
    bool are_hidden = false;          // all of them have a scale of 0
};

// What poses are made from: the loader's own.
struct PoseSource {
    const Model &model;
    const Primitives &primitives;
    const Clips &clips;
    const std::vector<Skin> &skins;
    const std::vector<std::ptrdiff_t> &visit_of; // [node]: its index in `placed`; −1: none
};

// Whether a node with this matrix draws nothing.
bool is_hidden(const glint_mat4 &matrix);

// Where a primitive is drawn, and whether a scale of 0 hides it.
struct Stand {
    glint_mat4 to_world;
    bool is_hidden;
};

// The weights of a node's morph targets at a time: its curve's, else its own, else its mesh's.
// Empty: all 0.
std::vector<double> weights_at(const PoseSource &source, std::size_t node, double time);

// Whether they ever change.
bool weights_move(const Clips &clips, std::size_t node);

// Nodes that deform a mesh alike share its shapes.
class Poses
{
  public:
    // Forgets what was, and takes a time, with where the visited nodes stand.
    void begin(const PoseSource &source, double time, const std::vector<glint_mat4> &placed);

    // Takes the shapes back.
    void clear()
    {
        shapes_.clear();
    }

    // The shapes of the primitives of a node's mesh; empty where it has neither targets nor a skin.
    // They last until begin() or clear().
    const std::vector<Shape> &shapes_of(const PoseSource &source, std::size_t node);

    // All that have anything to compute, in an order that depends on the file alone.
    std::vector<Shape *> deforming();

    // Of a primitive with that shape (NULL: the file's own) at a node with that skin. Joints alone
    // place what is skinned, and only all of them together can hide it.
    Stand stand_of(const Shape *shape, int skin, const glint_mat4 &node_to_world) const;

  private:
    using Key = std::tuple<int, std::ptrdiff_t, int>; // mesh; node of the weights, or −1; skin
    double time_ = 0;
    std::vector<Bones> bones_; // of each skin; empty where no visited node uses it
    std::map<Key, std::vector<Shape>> shapes_;
};

} // namespace glint

#endif
