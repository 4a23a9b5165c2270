// Decides which lobes a material has. See material.h.
#include "scene/material/material.h"

#include "kernels/layout.h"

#include <float.h>
#include <math.h>

#define START_NUMBER(start) start
#define START_COLOR(start)                                                                         \
    {                                                                                              \
        start, start, start                                                                        \
    }
#define START_PAIR(start)                                                                          \
    {                                                                                              \
        TWO start                                                                                  \
    }
#define TWO(first, second) first, second
#define START(kind, name_, least, most, start, ...) .name_ = START_##kind(start),
const glint_material glint_material_default = {GLINT_MATERIAL_TABLE(START)};
#undef START

enum { NUMBER = 1, PAIR = 2, COLOR = 3 };
#define CORE NULL
#define ROW(kind, name_, least_, most_, start, extension_, key_, meaning)                          \
    {.name = #name_,                                                                               \
     .offset = offsetof(glint_material, name_),                                                    \
     .count = (kind),                                                                              \
     .least = (double)(least_),                                                                    \
     .most = (double)(most_),                                                                      \
     .extension = (extension_),                                                                    \
     .key = (key_)},
const glint_material_value glint_material_values[] = {GLINT_MATERIAL_TABLE(ROW)};
const size_t glint_material_value_count =
    sizeof glint_material_values / sizeof *glint_material_values;
#undef ROW
#undef CORE

static bool is_white(const float color[3])
{
    return color[0] == 1 && color[1] == 1 && color[2] == 1;
}

static bool absorbs(const glint_material *m)
{
    const float *left = m->attenuation_color;
    return isfinite(m->attenuation_distance) && (left[0] < 1 || left[1] < 1 || left[2] < 1);
}

bool glint_material_is_textured(const glint_material *m)
{
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        if (m->textures[slot].image != 0) {
            return true;
        }
    }
    return false;
}

static bool has_texture(const glint_material *m, glint_texture_slot slot)
{
    return m->textures[slot].image != 0;
}

bool glint_material_media_are_alike(const glint_material *a, const glint_material *b)
{
    bool alike = a->ior == b->ior && a->dispersion == b->dispersion && a->priority == b->priority &&
                 a->attenuation_distance == b->attenuation_distance;
    for (int k = 0; k < 3; k++) {
        alike = alike && a->attenuation_color[k] == b->attenuation_color[k];
    }
    return alike;
}

const glint_texture_use *glint_material_normal_texture(const glint_material *m)
{
    return &m->textures[has_texture(m, GLINT_TEXTURE_NORMAL) ? GLINT_TEXTURE_NORMAL
                                                             : GLINT_TEXTURE_CLEARCOAT_NORMAL];
}

bool glint_material_needs_tangents(const glint_material *m)
{
    return glint_material_normal_texture(m)->image != 0 || glint_material_lobes(m).brushed;
}

const glint_texture_use *glint_material_tangent_texture(const glint_material *m)
{
    const glint_texture_use *normal = glint_material_normal_texture(m);
    return normal->image != 0 ? normal : &m->textures[GLINT_TEXTURE_ANISOTROPY];
}

// True if alpha can be less than 1.
static bool has_alpha(const glint_material *m)
{
    return m->alpha < 1 || m->has_vertex_colors || has_texture(m, GLINT_TEXTURE_BASE_COLOR);
}

// True if KHR_materials_specular changes the reflection.
static bool is_specular(const glint_material *m)
{
    return m->specular != 1 || !is_white(m->specular_color) ||
           has_texture(m, GLINT_TEXTURE_SPECULAR) || has_texture(m, GLINT_TEXTURE_SPECULAR_COLOR);
}

// True if a lobe needs a path. A wide lobe does not: the environment alone lights it.
static bool needs_path(const glint_material *m, float roughness, glint_texture_slot slot)
{
    return roughness < GLINT_COAT_MATTE || has_texture(m, slot);
}

static void add_clearcoat(const glint_material *m, glint_lobes *lobes)
{
    lobes->clearcoat = m->clearcoat > 0;
    lobes->rough_clearcoat = lobes->clearcoat && m->clearcoat_roughness >= GLINT_ROUGHNESS_LEAST;
    lobes->rough_clearcoat_path =
        lobes->rough_clearcoat &&
        needs_path(m, m->clearcoat_roughness, GLINT_TEXTURE_CLEARCOAT_ROUGHNESS);
}

// Returns the lobes that share the light, without coverage.
static glint_lobes sharing_lobes(const glint_material *m)
{
    glint_lobes lobes = {0};
    if (m->unlit) {
        lobes.unlit = true;
        return lobes;
    }
    lobes.emission = m->emission[0] > 0 || m->emission[1] > 0 || m->emission[2] > 0;
    if (m->mirror >= 0) {
        lobes.blend = true;
        lobes.blend_mirror = m->mirror > 0;
        return lobes;
    }
    // A texture can only lower the factor that it multiplies.
    const bool dielectric = m->metallic < 1 || has_texture(m, GLINT_TEXTURE_METALLIC_ROUGHNESS);
    const bool is_colored = !is_white(m->base_color) || m->has_vertex_colors ||
                            has_texture(m, GLINT_TEXTURE_BASE_COLOR);
    lobes.metal = m->metallic > 0;
    lobes.iridescent = m->iridescence > 0;
    lobes.tint = lobes.metal && (is_colored || lobes.iridescent);
    lobes.glass = dielectric && m->transmission > 0;
    lobes.solid = lobes.glass && m->thickness > 0;
    lobes.absorption = lobes.solid && absorbs(m);
    lobes.dispersion = lobes.solid && m->dispersion > 0;
    lobes.thin = lobes.glass && !lobes.solid;
    lobes.paint = dielectric && (m->transmission < 1 || has_texture(m, GLINT_TEXTURE_TRANSMISSION));
    lobes.translucent = lobes.paint && m->diffuse_transmission > 0;
    lobes.specular = (lobes.paint || lobes.glass) && is_specular(m);
    lobes.rough = (lobes.metal || lobes.paint) && !lobes.glass &&
                  (m->roughness >= GLINT_ROUGHNESS_LEAST || m->anisotropy > 0);
    lobes.brushed = lobes.rough && m->anisotropy > 0;
    lobes.rough_path = lobes.rough && (lobes.metal || needs_path(m, m->roughness,
                                                                 GLINT_TEXTURE_METALLIC_ROUGHNESS));
    lobes.sheen = (lobes.metal || lobes.paint) && !lobes.glass &&
                  (m->sheen_color[0] > 0 || m->sheen_color[1] > 0 || m->sheen_color[2] > 0);
    lobes.facets = lobes.glass && m->roughness >= GLINT_ROUGHNESS_LEAST;
    lobes.gloss = lobes.paint && (!(m->roughness >= GLINT_ROUGHNESS_LEAST) || lobes.facets ||
                                  has_texture(m, GLINT_TEXTURE_METALLIC_ROUGHNESS));
    add_clearcoat(m, &lobes);
    return lobes;
}

glint_lobes glint_material_lobes(const glint_material *m)
{
    glint_lobes lobes = sharing_lobes(m);
    if (!lobes.solid) {
        lobes.masked =
            m->alpha_mode == GLINT_ALPHA_MASK && (has_alpha(m) || m->alpha < m->alpha_cutoff);
        lobes.covers = m->alpha_mode == GLINT_ALPHA_BLEND && has_alpha(m);
    }
    return lobes;
}
