// Finds whether alpha ever counts. See coverage.h.
#include "scene/gltf/coverage.h"

// Returns the least alpha of the base colour's texture; 1 if there is none.
static double least_of_texture(const glint_textures *textures, const glint_material *material)
{
    const uint32_t image = material->textures[GLINT_TEXTURE_BASE_COLOR].image;
    if (textures == NULL || image == 0) {
        return 1;
    }
    const glint_texture *texture = &textures->textures[image - 1];
    const size_t pitch = glint_texture_pitch(texture->width);
    uint16_t least = UINT16_MAX;
    for (size_t y = 0; y < (size_t)texture->height; y++) {
        for (size_t x = 0; x < (size_t)texture->width; x++) {
            const uint16_t alpha = textures->texels[texture->first[0] + y * pitch + x][3];
            least = alpha < least ? alpha : least;
        }
    }
    return (double)least / UINT16_MAX;
}

// Returns the least alpha of the vertices' colours; 1 if there are none.
static double least_of_vertices(const glint_scene *scene, uint32_t number)
{
    const glint_attributes *set = &scene->attribute_set;
    if (!set->colors) {
        return 1;
    }
    const size_t stride = glint_attributes_stride(set);
    const size_t alpha =
        (set->texcoords ? 2U : 0U) + (set->second_texcoords ? 2U : 0U) + 3; // after R, G and B
    double least = 1;
    for (size_t t = 0; t < scene->triangle_count; t++) {
        for (size_t c = 0; scene->material_of[t] == number && c < 3; c++) {
            const size_t vertex = glint_scene_vertex(scene, t, c);
            least = fmin(least, (double)scene->attributes[vertex * stride + alpha]);
        }
    }
    return least;
}

bool glint_coverage_is_lost(const glint_scene *scene, const glint_textures *textures,
                            const glint_material *material, uint32_t number)
{
    if (material->alpha_mode == GLINT_ALPHA_OPAQUE || !glint_material_lobes(material).solid) {
        return false;
    }
    const double least = (double)material->alpha * least_of_texture(textures, material) *
                         least_of_vertices(scene, number);
    return least < (material->alpha_mode == GLINT_ALPHA_BLEND ? 1 : (double)material->alpha_cutoff);
}
