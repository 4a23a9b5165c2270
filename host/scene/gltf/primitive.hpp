// Prepares primitives for drawing: opens their accessors and checks the contents. This happens
// once, for any number of nodes that draw them.
#ifndef GLINT_SCENE_GLTF_PRIMITIVE_HPP
#define GLINT_SCENE_GLTF_PRIMITIVE_HPP

#include "scene/gltf/json.hpp"
#include "scene/gltf/model.hpp"
#include "scene/gltf/primitive.h"
#include "scene/gltf/tally.hpp"

#include <vector>

namespace glint
{

struct Primitives {
    Primitives() = default;
    Primitives(Primitives &&) = default;
    Primitives &operator=(Primitives &&) = default;
    Primitives(const Primitives &) = delete; // `all` points into the copied one's arrays
    Primitives &operator=(const Primitives &) = delete;
    ~Primitives() = default;

    std::vector<glint_primitive> all;
    std::vector<std::size_t> first; // [mesh]: index of its first primitive; and the end
    // [primitive]: what `all` points to.
    std::vector<std::vector<glint_morph_target>> targets;
    std::vector<std::vector<glint_influences>> influences;
};

// The primitive's place in the file.
inline Place place_of(const glint_primitive &primitive)
{
    return ((Place() / "meshes")[primitive.mesh] / "primitives")[primitive.number];
}

Primitives prepare_primitives(const Model &model, Tally &tally);

} // namespace glint

#endif
