// Checks and reads skins.
#ifndef GLINT_SCENE_GLTF_SKIN_HPP
#define GLINT_SCENE_GLTF_SKIN_HPP

#include "base/vector.h"
#include "scene/gltf/json.hpp"
#include "scene/gltf/model.hpp"

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

} // namespace glint

#endif
