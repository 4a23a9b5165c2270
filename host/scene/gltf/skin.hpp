// Checks and reads skins, and blends the joints' matrices for a vertex.
#ifndef GLINT_SCENE_GLTF_SKIN_HPP
#define GLINT_SCENE_GLTF_SKIN_HPP

#include "base/vector.h"
#include "scene/gltf/accessor.hpp"

#include <string>
#include <vector>

namespace glint
{

// Checks skins and fills model.skins. Refuses joints that are no nodes, and matrices that are too
// few or of the wrong kind.
void check_skins(const json &root, Model &model);

// Refuses JOINTS_n and WEIGHTS_n of the wrong kind, and either without the other.
void check_influences(const json &attributes, const Place &place, const Model &model);

struct Skin {
    std::vector<std::size_t> joints;      // nodes
    std::vector<glint_mat4> inverse_bind; // [joint]: from the bound mesh to the joint
};

// Refuses matrices that are not finite, or whose last row is not 0 0 0 1.
std::vector<Skin> read_skins(const Model &model);

// A set of four joints and weights per vertex; a primitive may have several sets.
struct Influences {
    Reader joints, weights;
};

// The verdict on a vertex's weights.
enum class Weighting {
    good,
    not_one,   // the sum is not 1, beyond rounding in files: normalise
    none,      // all are 0: the vertex follows the first joint that it names
    no_weight, // a weight is negative, infinite or NaN: refuse
    no_joint,  // a weight above 0 is for a joint that the skin lacks: refuse
};

inline bool is_fault(Weighting weighting)
{
    return weighting >= Weighting::no_weight;
}

// Computes the mean of the joints' matrices at a vertex, weighted by weight over the sum of
// weights. `matrices` are those of the skin's joints, from the bound mesh to the world. Allocates
// nothing. If is_fault(), `blend` is not set.
Weighting blend_joints(const std::vector<Influences> &sets, std::size_t vertex,
                       const std::vector<glint_mat4> &matrices, glint_mat4 &blend);

// Refuses the vertex's first faulty influence by name.
[[noreturn]] void refuse_influence(const std::vector<Influences> &sets, std::size_t vertex,
                                   std::size_t joint_count, const Place &primitive_place);

} // namespace glint

#endif
