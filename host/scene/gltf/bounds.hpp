// Axis-aligned bounds that grow; empty at first.
#ifndef GLINT_SCENE_GLTF_BOUNDS_HPP
#define GLINT_SCENE_GLTF_BOUNDS_HPP

#include "base/vector.h"

#include <algorithm>
#include <cmath>

namespace glint
{

struct Bounds {
    glint_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};

    bool is_empty() const
    {
        return !(low.x <= high.x);
    }

    // Ignores NaN.
    void grow(glint_vec3 p)
    {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
};

} // namespace glint

#endif
