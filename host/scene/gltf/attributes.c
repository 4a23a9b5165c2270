// Stores the vertices' texture coordinates, colours and tangents. See attributes.h.
#include "scene/gltf/attributes.h"

#include <math.h>

static void tally(glint_load *load, const glint_primitive *primitive, const char *said)
{
    char place[GLINT_PRIMITIVE_PLACE];
    glint_tally_add(&load->tally, said, glint_primitive_place(primitive, place));
}

// The index of a primitive's material in load->materials.
static const glint_used_material *material_of(const glint_load *load,
                                              const glint_primitive *primitive)
{
    const size_t count = load->document.materials_count;
    return &load->materials[primitive->material < 0 ? count : (size_t)primitive->material];
}

// Returns the place of the next attribute.
static float *store_texcoords(glint_load *load, const glint_primitive *primitive, int set,
                              size_t vertex, float *stored)
{
    double uv[2] = {0, 0};
    if (primitive->texcoords[set].count > 0) {
        glint_array_numbers(&primitive->texcoords[set], vertex, 2, uv);
    }
    for (int i = 0; i < 2; i++) {
        stored[i] = (float)uv[i];
        if (!isfinite(uv[i])) {
            tally(load, primitive, "texture coordinates that are not finite count as 0");
            stored[i] = 0;
        }
    }
    return stored + 2;
}

// Stores 1 if the material uses no colours: an override may have removed them. Returns the place of
// the next attribute.
static float *store_color(glint_load *load, const glint_primitive *primitive, size_t vertex,
                          float *stored)
{
    double rgba[4] = {1, 1, 1, 1};
    if (material_of(load, primitive)->material.has_vertex_colors) {
        glint_array_numbers(&primitive->colors, vertex, primitive->color_components, rgba);
    }
    for (int i = 0; i < 4; i++) {
        if (isnan(rgba[i])) {
            tally(load, primitive, "colours that are no numbers count as 1");
            rgba[i] = 1;
        }
        stored[i] = (float)fmin(fmax(rgba[i], 0.0), 1.0);
    }
    return stored + 4;
}

// Stores zeros if the file has no usable tangent. Tangents of a morphed or skinned mesh do not fit
// any more and are computed anew.
static void store_tangent(const glint_draw *draw, size_t vertex, float *stored)
{
    double t[4] = {0, 0, 0, 0};
    if (draw->primitive->tangents.count > 0 && draw->shape == NULL) {
        glint_array_numbers(&draw->primitive->tangents, vertex, 4, t);
    }
    const glint_vec3 world =
        glint_vec3_normalize(glint_mat4_direction(&draw->to_world, (glint_vec3){t[0], t[1], t[2]}));
    const bool is_usable = world.x != 0 || world.y != 0 || world.z != 0;
    // A mirroring node flips the bitangent.
    const bool is_mirrored = glint_mat4_determinant3(&draw->to_world) < 0;
    stored[0] = (float)world.x;
    stored[1] = (float)world.y;
    stored[2] = (float)world.z;
    stored[3] = !is_usable ? 0.0F : (t[3] < 0) != is_mirrored ? -1.0F : 1.0F;
}

glint_attributes glint_attributes_needed(const glint_load *load)
{
    glint_attributes set = {0};
    for (size_t i = 0; i <= load->document.materials_count; i++) {
        const glint_material *material = &load->materials[i].material;
        if (!load->materials[i].is_used) {
            continue;
        }
        for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
            const glint_texture_use *use = &material->textures[slot];
            set.texcoords = set.texcoords || use->image != 0;
            set.second_texcoords = set.second_texcoords || (use->image != 0 && use->texcoord == 1);
        }
        // Computed tangents follow texture coordinates.
        const bool tangents = glint_material_needs_tangents(material);
        set.tangents = set.tangents || tangents;
        set.texcoords = set.texcoords || tangents;
        set.colors = set.colors || material->has_vertex_colors;
    }
    return set;
}

void glint_attributes_store(glint_load *load, const glint_draw *draw, size_t vertex,
                            const glint_attributes *set, float *stored)
{
    if (set->texcoords) {
        stored = store_texcoords(load, draw->primitive, 0, vertex, stored);
    }
    if (set->second_texcoords) {
        stored = store_texcoords(load, draw->primitive, 1, vertex, stored);
    }
    if (set->colors) {
        stored = store_color(load, draw->primitive, vertex, stored);
    }
    if (set->tangents) {
        store_tangent(draw, vertex, stored);
    }
}
