// Finds whether alpha ever counts. See coverage.hpp.
#include "scene/gltf/coverage.hpp"

#include <algorithm>

namespace glint
{

namespace
{

// Returns the least alpha of the base colour's texture; 1 if there is none.
double least_of_texture(const glint_textures *textures, const glint_material &material)
{
    const std::uint32_t image = material.textures[GLINT_TEXTURE_BASE_COLOR].image;
    if (textures == nullptr || image == 0) {
        return 1;
    }
    const glint_texture &texture = textures->textures[image - 1];
    std::uint16_t least = UINT16_MAX;
    for (int y = 0; y < texture.height; y++) {
        const auto *row = textures->texels + texture.first[0] +
                          static_cast<std::size_t>(y) * glint_texture_pitch(texture.width);
        for (int x = 0; x < texture.width; x++) {
            least = std::min(least, row[x][3]);
        }
    }
    return double(least) / UINT16_MAX;
}

// Returns the least alpha of the vertices' colours; 1 if there are none.
double least_of_vertices(const glint_scene &scene, std::uint32_t number)
{
    const glint_attributes &set = scene.attribute_set;
    if (!set.colors) {
        return 1;
    }
    const std::size_t stride = glint_attributes_stride(&set);
    const std::size_t alpha =
        (set.texcoords ? 2 : 0) + std::size_t(set.second_texcoords ? 2 : 0) + 3;
    double least = 1;
    for (std::size_t t = 0; t < scene.triangle_count; t++) {
        for (std::size_t c = 0; scene.material_of[t] == number && c < 3; c++) {
            least = std::min(least, double(scene.attributes[(3 * t + c) * stride + alpha]));
        }
    }
    return least;
}

} // namespace

bool loses_alpha(const glint_scene &scene, const glint_textures *textures,
                 const glint_material &material, std::uint32_t number)
{
    if (material.alpha_mode == GLINT_ALPHA_OPAQUE || !glint_material_lobes(&material).solid) {
        return false;
    }
    const double least = double(material.alpha) * least_of_texture(textures, material) *
                         least_of_vertices(scene, number);
    return least < (material.alpha_mode == GLINT_ALPHA_BLEND ? 1 : double(material.alpha_cutoff));
}

} // namespace glint
