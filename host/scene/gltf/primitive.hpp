// Prepares primitives for drawing: opens their accessors and checks the contents. This happens
// once, for any number of nodes that draw them.
#ifndef GLINT_SCENE_GLTF_PRIMITIVE_HPP
#define GLINT_SCENE_GLTF_PRIMITIVE_HPP

#include "scene/gltf/accessor.hpp"
#include "scene/gltf/morph.hpp"
#include "scene/gltf/skin.hpp"
#include "scene/gltf/tally.hpp"

#include <vector>

namespace glint
{

struct Primitive {
    std::size_t mesh = 0, number = 0; // meshes[mesh].primitives[number]
    int mode = 4;                     // glTF's mode: 0 points, 1 to 3 lines, 4 list, 5 strip, 6 fan
    std::ptrdiff_t material = -1;
    std::size_t triangles = 0; // 0 for points and lines
    bool indexed = false, has_normals = false;
    bool has_tangents = false;
    std::array<bool, 2> has_texcoords{};
    std::size_t color_components = 0; // 3 or 4; 0: no colours
    Reader positions, normals, indices, tangents, colors;
    std::array<Reader, 2> texcoords;
    std::vector<MorphTarget> targets;
    std::vector<Influences> influences; // empty: no skin moves the primitive

    Place place() const
    {
        return ((Place() / "meshes")[mesh] / "primitives")[number];
    }

    // Returns the vertex at corner c of triangle t, in the mode's winding order.
    std::size_t vertex(std::size_t t, std::size_t c) const
    {
        std::size_t i = 3 * t + c;
        if (mode == 5) {
            // Every second triangle of a strip swaps two corners, so that all have the same
            // winding.
            i = t + (c == 0 ? 0 : (c == 1 ? 1 + t % 2 : 2 - t % 2));
        } else if (mode == 6) {
            i = c == 2 ? 0 : t + 1 + c;
        }
        return indexed ? indices.index(i) : i;
    }
};

struct Primitives {
    std::vector<Primitive> all;
    std::vector<std::size_t> first; // [mesh]: index of its first primitive; and the end
};

Primitives prepare_primitives(const Model &model, Tally &tally);

} // namespace glint

#endif
