// Stores the vertices' texture coordinates, colours and tangents. See attributes.hpp.
#include "scene/gltf/attributes.hpp"

#include <algorithm>
#include <cmath>

namespace glint
{

namespace
{

// Each function returns the place of the next attribute.
float *store_texcoords(const glint_primitive &primitive, std::size_t set, std::size_t vertex,
                       Tally &tally, float *stored)
{
    std::array<double, 2> uv{};
    if (primitive.texcoords[set].count > 0) {
        glint_array_numbers(&primitive.texcoords[set], vertex, 2, uv.data());
    }
    for (std::size_t i = 0; i < 2; i++) {
        stored[i] = static_cast<float>(uv[i]);
        if (!std::isfinite(uv[i])) {
            tally.add("texture coordinates that are not finite count as 0",
                      place_of(primitive).text());
            stored[i] = 0;
        }
    }
    return stored + 2;
}

// Stores 1 if the material uses no colours: an override may have removed them.
float *store_color(Load &load, const glint_primitive &primitive, std::size_t vertex, float *stored)
{
    std::array<double, 4> rgba = {1, 1, 1, 1};
    if (load.materials.at(primitive.material).material.has_vertex_colors) {
        glint_array_numbers(&primitive.colors, vertex, primitive.color_components, rgba.data());
    }
    for (std::size_t i = 0; i < 4; i++) {
        if (std::isnan(rgba[i])) {
            load.tally.add("colours that are no numbers count as 1", place_of(primitive).text());
            rgba[i] = 1;
        }
        stored[i] = static_cast<float>(std::clamp(rgba[i], 0.0, 1.0));
    }
    return stored + 4;
}

// Stores zeros if the file has no usable tangent. Tangents of a morphed or skinned mesh do not fit
// any more and are computed anew.
float *store_tangent(const Draw &draw, std::size_t vertex, float *stored)
{
    std::array<double, 4> t{};
    if (draw.primitive->tangents.count > 0 && draw.shape == nullptr) {
        glint_array_numbers(&draw.primitive->tangents, vertex, 4, t.data());
    }
    const glint_vec3 world =
        glint_vec3_normalize(glint_mat4_direction(&draw.to_world, {t[0], t[1], t[2]}));
    const bool is_usable = world.x != 0 || world.y != 0 || world.z != 0;
    // A mirroring node flips the bitangent.
    const bool is_mirrored = glint_mat4_determinant3(&draw.to_world) < 0;
    stored[0] = static_cast<float>(world.x);
    stored[1] = static_cast<float>(world.y);
    stored[2] = static_cast<float>(world.z);
    stored[3] = !is_usable ? 0.0F : (t[3] < 0) != is_mirrored ? -1.0F : 1.0F;
    return stored + 4;
}

} // namespace

glint_attributes attributes_of(const Load &load)
{
    glint_attributes set = {};
    for (const auto &one : load.materials) {
        for (const glint_texture_use &use : one.second.material.textures) {
            set.texcoords = set.texcoords || use.image != 0;
            set.second_texcoords = set.second_texcoords || (use.image != 0 && use.texcoord == 1);
        }
        // Computed tangents follow texture coordinates.
        const bool tangents = glint_material_needs_tangents(&one.second.material);
        set.tangents = set.tangents || tangents;
        set.texcoords = set.texcoords || tangents;
        set.colors = set.colors || one.second.material.has_vertex_colors;
    }
    return set;
}

void store_attributes(Load &load, const Draw &draw, const std::array<std::size_t, 3> &corners,
                      const glint_attributes &set, float *stored)
{
    const glint_primitive &primitive = *draw.primitive;
    for (const std::size_t vertex : corners) {
        if (set.texcoords) {
            stored = store_texcoords(primitive, 0, vertex, load.tally, stored);
        }
        if (set.second_texcoords) {
            stored = store_texcoords(primitive, 1, vertex, load.tally, stored);
        }
        if (set.colors) {
            stored = store_color(load, primitive, vertex, stored);
        }
        if (set.tangents) {
            stored = store_tangent(draw, vertex, stored);
        }
    }
}

} // namespace glint
