// Names the purposes of textures, and holds the images. See texture.h.
#include "scene/texture/texture.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

const char *glint_texture_slot_name(glint_texture_slot slot)
{
    static const char *const names[] = {
        [GLINT_TEXTURE_BASE_COLOR] = "base colour",
        [GLINT_TEXTURE_METALLIC_ROUGHNESS] = "metallic and roughness",
        [GLINT_TEXTURE_OCCLUSION] = "occlusion",
        [GLINT_TEXTURE_NORMAL] = "normal",
        [GLINT_TEXTURE_EMISSION] = "emission",
        [GLINT_TEXTURE_TRANSMISSION] = "transmission",
        [GLINT_TEXTURE_SPECULAR] = "specular",
        [GLINT_TEXTURE_SPECULAR_COLOR] = "specular colour",
        [GLINT_TEXTURE_CLEARCOAT] = "clearcoat",
        [GLINT_TEXTURE_CLEARCOAT_ROUGHNESS] = "clearcoat roughness",
        [GLINT_TEXTURE_CLEARCOAT_NORMAL] = "clearcoat normal",
        [GLINT_TEXTURE_ANISOTROPY] = "anisotropy",
        [GLINT_TEXTURE_SHEEN_COLOR] = "sheen colour",
        [GLINT_TEXTURE_SHEEN_ROUGHNESS] = "sheen roughness",
        [GLINT_TEXTURE_DIFFUSE_TRANSMISSION] = "diffuse transmission",
        [GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR] = "diffuse transmission colour",
        [GLINT_TEXTURE_IRIDESCENCE] = "iridescence",
        [GLINT_TEXTURE_IRIDESCENCE_THICKNESS] = "iridescence thickness",
    };
    return names[slot];
}

bool glint_texture_slot_is_color(glint_texture_slot slot)
{
    return slot == GLINT_TEXTURE_BASE_COLOR || slot == GLINT_TEXTURE_EMISSION ||
           slot == GLINT_TEXTURE_SPECULAR_COLOR || slot == GLINT_TEXTURE_SHEEN_COLOR ||
           slot == GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR;
}

glint_status glint_textures_join(glint_texture_levels *images, size_t count,
                                 glint_textures **textures, glint_error *error)
{
    glint_textures *all = glint_allocate(1, sizeof *all);
    size_t texels = 0;
    for (size_t i = 0; i < count; i++) {
        texels += images[i].texel_count;
    }
    if (all != NULL) {
        all->owners = 1;
        all->textures = glint_allocate(count, sizeof *all->textures);
        if (count == 1) { // a single image keeps its memory
            all->texels = images->texels;
            images->texels = NULL;
        }
        if (all->texels == NULL) {
            all->texels = glint_allocate_unset(texels, sizeof *all->texels);
        }
    }
    if (all == NULL || all->textures == NULL || all->texels == NULL) {
        glint_textures_release(all);
        return glint_fail_memory(error, "the textures");
    }
    for (size_t i = 0; i < count; i++) {
        glint_texture *texture = &all->textures[all->count++];
        *texture = images[i].texture;
        for (int k = 0; k < texture->levels; k++) {
            texture->first[k] += all->texel_count;
        }
        // NULL: the texels are in place, or the image could not be read.
        if (images[i].texels != NULL) {
            memcpy(all->texels + all->texel_count, images[i].texels,
                   images[i].texel_count * sizeof *all->texels);
        }
        all->texel_count += images[i].texel_count;
        free(images[i].texels);
        images[i] = (glint_texture_levels){0};
    }
    *textures = all;
    return GLINT_OK;
}

size_t glint_textures_bytes(const glint_textures *textures)
{
    return textures != NULL ? textures->texel_count * sizeof *textures->texels : 0;
}

glint_textures *glint_textures_share(glint_textures *textures)
{
    if (textures != NULL) {
        __atomic_add_fetch(&textures->owners, 1, __ATOMIC_RELAXED);
    }
    return textures;
}

void glint_textures_release(glint_textures *textures)
{
    if (textures != NULL && __atomic_sub_fetch(&textures->owners, 1, __ATOMIC_ACQ_REL) == 0) {
        free(textures->textures);
        free(textures->texels);
        free(textures);
    }
}
