// Reads the chosen animations of a glTF file as curves of nodes.
#ifndef GLINT_SCENE_GLTF_CLIPS_HPP
#define GLINT_SCENE_GLTF_CLIPS_HPP

#include "scene/gltf/curve.h"
#include "scene/gltf/file.hpp"
#include "scene/gltf/model.hpp"
#include "scene/gltf/tally.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace glint
{

enum Property : std::size_t { translation, rotation, scale, weights };

// A curve that owns its arrays.
struct Curve {
    std::vector<double> times, values;
    glint_interpolation interpolation = GLINT_INTERPOLATION_LINEAR;
    bool is_rotation = false;
    std::size_t components = 3;

    glint_curve view() const
    {
        return {interpolation, is_rotation, components, times.size(), times.data(), values.data()};
    }
};

// The curves of a node's properties; empty for properties that do not move.
struct Moves {
    std::array<Curve, 4> of;
};

struct Clips {
    std::map<std::size_t, Moves> nodes;
    std::string name;    // name of the clip, or of the first of several; may be empty
    double duration = 0; // seconds to the last key
};

// Reads the clip by name or index, or "all" or "none"; NULL: the first, if any. Leaves out curves
// that a node cannot follow, that glint does not model or that cannot be read, and tallies them.
Clips read_clips(const Document &document, const Model &model, const char *name, Tally &tally);

} // namespace glint

#endif
