// Skins: checked, read, and the mean of joint matrices that a vertex follows.
#ifndef GLINT_SCENE_GLTF_SKIN_HPP
#define GLINT_SCENE_GLTF_SKIN_HPP

#include "base/vector.h"
#include "scene/gltf_accessor.hpp"

#include <string>
#include <vector>

namespace glint
{

// Refuses joints that are no nodes, and matrices that are too few or of the wrong kind. Fills
// model.skins.
void check_skins(const json &root, Model &model);

// Refuses JOINTS_n and WEIGHTS_n of the wrong kind, and one without the other.
void check_influences(const json &attributes, const Place &place, const Model &model);

struct Skin {
    std::vector<std::size_t> joints;      // nodes
    std::vector<glint_mat4> inverse_bind; // of each joint: from the mesh as bound to the joint
};

// Refuses matrices that are not finite, or whose last row is not 0 0 0 1.
std::vector<Skin> read_skins(const Model &model);

// A set of four joints and weights a vertex; a primitive may have several.
struct Influences {
    Reader joints, weights;
};

// What a vertex's weights are.
enum class Weighting {
    good,
    not_one,   // their sum is not 1, beyond what files round: they are normalised
    none,      // all are 0: the vertex follows the first joint that it names
    no_weight, // one is negative, infinite or NaN: nothing can be made of it
    no_joint,  // one that is not 0 is for a joint that the skin has not
};

inline bool is_fault(Weighting weighting)
{
    return weighting >= Weighting::no_weight;
}

// The mean of the joints' matrices at a vertex, by its weights over their sum. `matrices` are those
// of the skin's joints, from the mesh as bound to the world. Allocates nothing. Where is_fault()
// the matrix is not set.
Weighting blend_joints(const std::vector<Influences> &sets, std::size_t vertex,
                       const std::vector<glint_mat4> &matrices, glint_mat4 &blend);

// Names the vertex's first influence that is at fault.
[[noreturn]] void refuse_influence(const std::vector<Influences> &sets, std::size_t vertex,
                                   std::size_t joint_count, const Place &primitive_place);

} // namespace glint

#endif
