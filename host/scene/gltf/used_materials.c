// Takes the materials of drawn primitives. See used_materials.h.
#include "scene/gltf/used_materials.h"

#include "base/memory.h"
#include "scene/gltf/coverage.h"
#include "scene/gltf/notes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The file's material `i`; NULL: glTF's default material.
static const glint_document_material *source_of(const glint_load *load, size_t i)
{
    return i < load->document.materials_count ? &load->document.materials[i] : NULL;
}

static const char *name_of(const glint_load *load, size_t i)
{
    const glint_document_material *source = source_of(load, i);
    return source == NULL ? "" : glint_load_text(load, source->name);
}

// ---- Materials and overrides --------------------------------------------------------------------

static glint_status take_all(glint_load *load, glint_error *error)
{
    const size_t count = load->document.materials_count;
    load->materials = glint_allocate(count + 1, sizeof *load->materials);
    if (load->materials == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i <= count; i++) {
        glint_material *material = &load->materials[i].material;
        *material = i < count ? load->document.materials[i].material : glint_material_default;
        material->name = NULL;
        material->index = (int)i;
        material->has_vertex_colors = false;
        material->warnings = 0;
    }
    return GLINT_OK;
}

// Finds the overrides' materials among all materials of the file, because the materials in use may
// change over time.
static glint_status resolve_overrides(glint_load *load, glint_error *error)
{
    size_t count = load->document.materials_count;
    glint_material *materials = glint_allocate(count + 1, sizeof *materials);
    if (materials == NULL) {
        return glint_fail_memory(error, "the scene");
    }
    for (size_t i = 0; i <= count; i++) {
        const char *name = name_of(load, i);
        materials[i] = load->materials[i].material;
        materials[i].name = name[0] == '\0' ? NULL : (char *)name;
    }
    bool uses_default = false;
    for (size_t i = 0; i < load->document.primitives_count; i++) {
        uses_default = uses_default || load->primitives.all[i].material < 0;
    }
    count += uses_default ? 1 : 0;
    const glint_status status =
        glint_material_overrides_resolve(&load->overrides, materials, count, error);
    free(materials);
    return status;
}

// Notes which materials primitives of chosen nodes use, and which have vertex colours.
static void mark_used(glint_load *load)
{
    const size_t count = load->document.materials_count;
    for (size_t i = 0; i < load->visits.count; i++) {
        const glint_run primitives = glint_load_primitives(load, i);
        for (uint32_t p = 0; p < primitives.count; p++) {
            const glint_primitive *primitive = &load->primitives.all[primitives.first + p];
            if (primitive->triangles > 0) {
                glint_used_material *used =
                    &load->materials[primitive->material < 0 ? count : (size_t)primitive->material];
                used->is_used = true;
                used->material.has_vertex_colors =
                    used->material.has_vertex_colors || primitive->color_components > 0;
            }
        }
    }
}

static void override_material(glint_load *load, size_t i)
{
    glint_used_material *used = &load->materials[i];
    const char *name = name_of(load, i);
    used->material.name = name[0] == '\0' ? NULL : (char *)name;
    used->is_replaced = glint_material_overrides_apply(&load->overrides, &used->material);
    used->material.name = NULL;
}

// ---- Images -------------------------------------------------------------------------------------

// Sets each image to its number among the images that are read.
static glint_status number_images(glint_load *load, glint_material *material, glint_error *error)
{
    for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
        glint_texture_use *use = &material->textures[slot];
        if (use->image != 0) {
            const bool is_coverage =
                slot == GLINT_TEXTURE_BASE_COLOR && material->alpha_mode != GLINT_ALPHA_OPAQUE;
            const bool is_color = glint_texture_slot_is_color((glint_texture_slot)slot);
            use->image = glint_images_number(&load->images, &load->document, use->image - 1,
                                             is_color, is_coverage);
            if (use->image == 0) {
                return glint_fail_memory(error, "the scene");
            }
        }
    }
    return GLINT_OK;
}

static bool is_black(const float color[3])
{
    return !(color[0] > 0 || color[1] > 0 || color[2] > 0);
}

// False if the picture does not show the texture, because what it multiplies is 0.
static bool is_seen(int slot, const glint_material *m)
{
    if (m->unlit) {
        return slot == GLINT_TEXTURE_BASE_COLOR;
    }
    switch (slot) {
    case GLINT_TEXTURE_EMISSION:
        return !is_black(m->emission);
    case GLINT_TEXTURE_TRANSMISSION:
        return m->transmission > 0;
    case GLINT_TEXTURE_CLEARCOAT:
    case GLINT_TEXTURE_CLEARCOAT_ROUGHNESS:
    case GLINT_TEXTURE_CLEARCOAT_NORMAL:
        return m->clearcoat > 0;
    case GLINT_TEXTURE_SHEEN_COLOR:
    case GLINT_TEXTURE_SHEEN_ROUGHNESS:
        return !is_black(m->sheen_color);
    case GLINT_TEXTURE_IRIDESCENCE:
    case GLINT_TEXTURE_IRIDESCENCE_THICKNESS:
        return m->iridescence > 0;
    case GLINT_TEXTURE_ANISOTROPY:
        return m->anisotropy > 0;
    case GLINT_TEXTURE_DIFFUSE_TRANSMISSION:
    case GLINT_TEXTURE_DIFFUSE_TRANSMISSION_COLOR:
        return m->diffuse_transmission > 0;
    default:
        return true;
    }
}

// Does without a texture: its factors alone count, and nothing is emitted.
static glint_status do_without(glint_load *load, glint_used_material *used, int slot,
                               const char *fault, const char *where)
{
    const bool is_kept = !used->is_replaced || slot == GLINT_TEXTURE_BASE_COLOR; // by a preset
    if (!is_kept || !is_seen(slot, &used->material)) {
        return GLINT_OK;
    }
    if (slot == GLINT_TEXTURE_EMISSION) {
        // The factor alone would make the whole surface shine, where most maps are black but for a
        // few lamps.
        memset(used->material.emission, 0, sizeof used->material.emission);
    }
    char *text = NULL;
    if (asprintf(&text, "%s; the maps that need it are left out", fault) < 0) {
        return GLINT_OUT_OF_MEMORY;
    }
    glint_tally_add_once(&load->tally, text, where);
    free(text);
    return GLINT_OK;
}

static glint_status settle(glint_load *load, size_t i, glint_error *error)
{
    glint_used_material *used = &load->materials[i];
    const glint_document_material *source = source_of(load, i);
    glint_status status = GLINT_OK;
    load->tally.material = (int)i;
    for (uint32_t k = 0; source != NULL && status == GLINT_OK && k < source->missing.count; k++) {
        const glint_document_missing *missing = &load->document.missing[source->missing.first + k];
        status = do_without(load, used, missing->slot, glint_load_text(load, missing->text),
                            glint_load_text(load, missing->where));
    }
    for (int slot = 0; status == GLINT_OK && slot < GLINT_TEXTURE_SLOTS; slot++) {
        glint_texture_use *use = &used->material.textures[slot];
        const glint_image_use *image = use->image == 0 ? NULL : &load->images.uses[use->image - 1];
        if (image != NULL && image->fault != NULL) {
            const glint_text shown = load->document.images[image->image].shown;
            used->lost |= 1U << slot;
            *use = (glint_texture_use){0};
            status = do_without(load, used, slot, image->fault, glint_load_text(load, shown));
        }
    }
    load->tally.material = -1;
    return status == GLINT_OK ? GLINT_OK : glint_fail_memory(error, "the scene");
}

glint_status glint_materials_take(glint_load *load, const glint_scene_options *options,
                                  glint_error *error)
{
    TRY(take_all(load, error));
    if (options->overrides != NULL) {
        load->overrides = *options->overrides;
        TRY(resolve_overrides(load, error));
    }
    mark_used(load);
    const size_t count = load->document.materials_count;
    for (size_t i = 0; i <= count; i++) {
        if (load->materials[i].is_used) {
            override_material(load, i);
            TRY(number_images(load, &load->materials[i].material, error));
        }
    }
    TRY(glint_images_read(&load->images, &load->document, load->folder, options->texture_size,
                          error));
    for (size_t i = 0; i <= count; i++) {
        if (load->materials[i].is_used) {
            TRY(settle(load, i, error));
        }
    }
    return GLINT_OK;
}

// ---- The scene's --------------------------------------------------------------------------------

// Tallies what concerns a used material. `loses_alpha`: see coverage.h.
static void survey(glint_load *load, size_t i, bool loses_alpha)
{
    const glint_document_material *source = source_of(load, i);
    char where[GLINT_WHERE];
    if (source == NULL) {
        (void)snprintf(where, sizeof where, "the default material");
    } else {
        (void)glint_name_place("materials", i, name_of(load, i), where);
    }
    load->tally.material = (int)i;
    if (loses_alpha) {
        glint_tally_add(&load->tally,
                        "alphaMode counts for nothing in glass with a volume: it is all there",
                        where);
    }
    if (source != NULL && !load->materials[i].is_replaced) {
        glint_notes_tally(&load->document, source->notes, where, &load->tally);
    }
    load->tally.material = -1;
}

static glint_status give_material(glint_load *load, size_t i, glint_scene *scene,
                                  glint_error *error)
{
    bool is_short = false;
    glint_material *material = &scene->materials[scene->material_count];
    *material = load->materials[i].material;
    material->name = glint_name_copy(name_of(load, i), &is_short);
    scene->material_count++;
    if (is_short) {
        return glint_fail_memory(error, "the scene");
    }
    survey(load, i, glint_coverage_is_lost(scene, load->images.textures, material, (uint32_t)i));
    return GLINT_OK;
}

glint_status glint_materials_give(glint_load *load, glint_scene *scene, glint_error *error)
{
    const size_t count = load->document.materials_count + 1;
    uint32_t *place = glint_allocate(count, sizeof *place); // 1 + place in the scene; 0: not used
    size_t used = 0;
    for (size_t i = 0; place != NULL && i < scene->instance_count; i++) {
        used += place[scene->instances[i].material] == 0 ? 1 : 0;
        place[scene->instances[i].material] = 1;
    }
    scene->materials = glint_allocate(used, sizeof *scene->materials);
    glint_status status = place != NULL && scene->materials != NULL
                              ? GLINT_OK
                              : glint_fail_memory(error, "the scene");
    for (size_t i = 0; status == GLINT_OK && i < count; i++) {
        if (place[i] != 0) {
            status = give_material(load, i, scene, error);
            place[i] = (uint32_t)scene->material_count;
        }
    }
    for (size_t i = 0; status == GLINT_OK && i < scene->instance_count; i++) {
        scene->instances[i].material = place[scene->instances[i].material] - 1;
    }
    for (size_t t = 0; status == GLINT_OK && t < scene->triangle_count; t++) {
        scene->material_of[t] = place[scene->material_of[t]] - 1;
    }
    free(place);
    return status;
}
