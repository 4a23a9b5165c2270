// Poses: the shapes of nodes' meshes at one time, by morph weights and joints.
#ifndef GLINT_SCENE_GLTF_POSE_HPP
#define GLINT_SCENE_GLTF_POSE_HPP

#include "scene/gltf/clips.hpp"
#include "scene/gltf/primitive.hpp"
#include "scene/gltf/shape.h"
#include "scene/gltf/skin.hpp"
#include "scene/gltf/tally.hpp"

#include <map>
#include <tuple>
#include <vector>

namespace glint
{

// A skin's joints at one time.
struct Bones {
    std::vector<glint_mat4> matrices; // from the bound mesh to the world
    bool are_hidden = false;          // all joints have a scale of 0
    glint_bones view = {};            // of `matrices`
};

// The shapes of a mesh's primitives; owns what they own.
class Shapes
{
  public:
    Shapes() = default;
    Shapes(const Shapes &) = delete;
    Shapes &operator=(const Shapes &) = delete;
    ~Shapes();

    std::vector<glint_shape> all;
};

// The loader's data from which poses are made.
struct PoseSource {
    const Model &model;
    const Primitives &primitives;
    const Clips &clips;
    const std::vector<Skin> &skins;
    const std::vector<std::ptrdiff_t> &visit_of; // [node]: index in `placed`; −1: none
};

// True if a node with this matrix draws nothing.
bool is_hidden(const glint_mat4 &matrix);

// The place of a drawn primitive. A scale of 0 hides it.
struct Stand {
    glint_mat4 to_world;
    bool is_hidden;
};

// The weights of a node's morph targets at a time, from its curve, else the node, else its mesh.
// Empty: all weights are 0.
std::vector<double> weights_at(const PoseSource &source, std::size_t node, double time);

// True if the weights ever change.
bool weights_move(const Clips &clips, std::size_t node);

// Computes the shapes. Throws what glint_shapes_deform refuses.
void deform(const std::vector<glint_shape *> &shapes, bool with_normals, Tally &tally);

// The shapes of all nodes. Nodes that deform a mesh alike share its shapes.
class Poses
{
  public:
    // Starts a new time; `placed` holds the matrices of the visited nodes. Drops all shapes.
    void begin(const PoseSource &source, double time, const std::vector<glint_mat4> &placed);

    // Drops all shapes.
    void clear()
    {
        shapes_.clear();
    }

    // Returns the shapes of the primitives of a node's mesh; empty without targets and skin. They
    // last until begin() or clear().
    const std::vector<glint_shape> &shapes_of(const PoseSource &source, std::size_t node);

    // Returns all shapes that deform, in an order that depends on the file alone.
    std::vector<glint_shape *> deforming();

    // Returns the place of a primitive with this shape (NULL: the file's own) at a node with this
    // skin. Only joints place a skinned primitive, and only all of them together can hide it.
    Stand stand_of(const glint_shape *shape, int skin, const glint_mat4 &node_to_world) const;

  private:
    using Key = std::tuple<int, std::ptrdiff_t, int>; // mesh; node of the weights, or −1; skin
    double time_ = 0;
    std::vector<Bones> bones_; // [skin]; empty if no visited node uses it
    std::map<Key, Shapes> shapes_;
};

} // namespace glint

#endif
