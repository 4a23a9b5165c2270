// Lists the glTF features that a file uses. See usage.h.
#include "scene/gltf/usage.h"

#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Usages in the order of first use.
typedef struct usage_list {
    glint_scene *scene;
    size_t capacity;
    bool is_short; // memory is short
} usage_list;

// If a name occurs twice, the worse treatment counts.
static void add(usage_list *usages, const char *name, glint_treatment treatment)
{
    glint_scene *scene = usages->scene;
    for (size_t i = 0; i < scene->usage_count; i++) {
        glint_usage *usage = &scene->usages[i];
        if (strcmp(usage->name, name) == 0) {
            usage->treatment = usage->treatment > treatment ? usage->treatment : treatment;
            return;
        }
    }
    if (name[0] == '\0') {
        return;
    }
    char *copy = strdup(name);
    usages->is_short = usages->is_short || copy == NULL ||
                       !glint_make_room((void **)&scene->usages, scene->usage_count,
                                        &usages->capacity, sizeof *scene->usages);
    if (usages->is_short) {
        free(copy);
        return;
    }
    scene->usages[scene->usage_count++] = (glint_usage){copy, treatment};
}

static void add_material(usage_list *usages, const glint_material *material)
{
    const glint_lobes lobes = glint_material_lobes(material);
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        if (material->textures[slot].image != 0) {
            char name[80];
            (void)snprintf(name, sizeof name, "texture: %s",
                           glint_texture_slot_name((glint_texture_slot)slot));
            add(usages, name, GLINT_RENDERED);
        }
    }
    if (material->roughness > 0 && (lobes.metal || lobes.glass || lobes.paint)) {
        add(usages, "roughness", GLINT_RENDERED);
    }
    if (lobes.masked || lobes.covers) {
        add(usages, lobes.masked ? "alphaMode MASK" : "alphaMode BLEND", GLINT_RENDERED);
    }
    if (material->has_vertex_colors) {
        add(usages, "COLOR_0", GLINT_RENDERED);
    }
}

// Adds what is left out of a used material. A thickness texture counts as approximated: light
// travels through the solid itself, and the texture is only an estimate of that distance.
static void add_losses(usage_list *usages, const glint_load *load, size_t i)
{
    const glint_document_material *source = &load->document.materials[i];
    const glint_used_material *used = &load->materials[i];
    for (uint32_t k = 0; k < source->missing.count; k++) {
        const glint_text key = load->document.missing[source->missing.first + k].key;
        add(usages, glint_load_text(load, key), GLINT_IGNORED);
    }
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        if ((used->lost >> slot & 1) != 0) {
            add(usages, glint_load_text(load, source->texture_keys[slot]), GLINT_IGNORED);
        }
    }
    if (!used->is_replaced && used->material.thickness > 0 && source->has_thickness_texture != 0) {
        add(usages, "thicknessTexture", GLINT_APPROXIMATED);
    }
}

static void add_meshes(usage_list *usages, const glint_load *load)
{
    for (size_t i = 0; i < load->visits.count; i++) {
        const glint_document_node *node = glint_load_node(load, i);
        const glint_run primitives = glint_load_primitives(load, i);
        for (uint32_t p = 0; p < primitives.count; p++) {
            const glint_primitive *primitive = &load->primitives.all[primitives.first + p];
            if (primitive->target_count > 0) {
                add(usages, "morph targets", GLINT_RENDERED);
            }
            if (node->skin >= 0 && primitive->influences.count > 0) {
                add(usages, "skins", GLINT_RENDERED);
            }
        }
    }
}

glint_status glint_usages_list(const glint_load *load, glint_scene *scene, glint_error *error)
{
    usage_list usages = {scene, 0, false};
    for (size_t i = 0; i < load->document.usages_count; i++) {
        const glint_document_usage *usage = &load->document.usages[i];
        add(&usages, glint_load_text(load, usage->name), (glint_treatment)usage->treatment);
    }
    for (size_t i = 0; i < scene->material_count; i++) {
        add_material(&usages, &scene->materials[i]);
    }
    for (size_t i = 0; i < load->document.materials_count; i++) {
        if (load->materials[i].is_used) {
            add_losses(&usages, load, i);
        }
    }
    add_meshes(&usages, load);
    if (scene->skipped_points + scene->skipped_lines > 0) {
        add(&usages, "points and lines", GLINT_IGNORED);
    }
    if (load->moves_triangles || load->moves_cameras || load->moves_lights) {
        add(&usages, "animation", GLINT_RENDERED);
    }
    return usages.is_short ? glint_fail_memory(error, "the scene") : GLINT_OK;
}
