// Animations of a glTF file: checked, and the chosen clips read as curves of nodes.
#ifndef GLINT_SCENE_GLTF_ANIMATION_HPP
#define GLINT_SCENE_GLTF_ANIMATION_HPP

#include "scene/animation.h"
#include "scene/gltf_file.hpp"
#include "scene/gltf_model.hpp"
#include "scene/gltf_tally.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace glint
{

// Refuses what refers to nothing, and accessors of the wrong kind or length. What is not modelled
// (pointers) passes.
void check_animations(const json &root, const Model &model);

enum Property : std::size_t { translation, rotation, scale, weights };

// A curve with what it borrows.
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

// The properties of a node that move; empty curves for those that do not.
struct Moves {
    std::array<Curve, 4> of;
};

struct Clips {
    std::map<std::size_t, Moves> nodes;
    std::string name;    // of the clip, or of the first of several; may be empty
    double duration = 0; // seconds, to the last key
};

// The clip of that name or index; "all", "none"; NULL: the first, if there is one. Curves that a
// node cannot follow, or that are not modelled, are tallied and left out.
Clips read_clips(const Document &document, const Model &model, const char *name, Tally &tally);

} // namespace glint

#endif
