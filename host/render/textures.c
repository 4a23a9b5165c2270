// Uploads textures. See textures.h.
#include "render/textures.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

static unsigned flags_of(const glint_texture_use *use)
{
    return (use->texcoord == 1 ? GLINT_TEXTURE_SECOND : 0) |
           (use->wrap_s == GLINT_WRAP_CLAMP ? GLINT_TEXTURE_CLAMP_S : 0) |
           (use->wrap_t == GLINT_WRAP_CLAMP ? GLINT_TEXTURE_CLAMP_T : 0) |
           (use->wrap_s == GLINT_WRAP_MIRROR ? GLINT_TEXTURE_MIRROR_S : 0) |
           (use->wrap_t == GLINT_WRAP_MIRROR ? GLINT_TEXTURE_MIRROR_T : 0) |
           (use->magnified_nearest ? GLINT_TEXTURE_MAGNIFIED_NEAREST : 0) |
           (use->minified_nearest ? GLINT_TEXTURE_MINIFIED_NEAREST : 0) |
           (use->mips == GLINT_MIP_NEAREST ? GLINT_TEXTURE_MIPS_NEAREST : 0) |
           (use->mips == GLINT_MIP_LINEAR && !use->minified_nearest ? GLINT_TEXTURE_TRILINEAR : 0);
}

static glint_texture_record record_of(const glint_textures *textures, const glint_texture_use *use)
{
    static const float identity[6] = {1, 0, 0, 0, 1, 0};
    const glint_texture *texture = &textures->textures[use->image - 1];
    glint_texture_record record = {
        .width = texture->width,
        .height = texture->height,
        .levels = use->mips == GLINT_MIP_NONE ? 1 : texture->levels,
        .flags = flags_of(use),
    };
    for (int level = 0; level < texture->levels; level++) {
        record.first[level] = (unsigned)texture->first[level];
    }
    bool is_moved = false;
    for (int i = 0; i < 6; i++) {
        is_moved = is_moved || use->transform[i] != 0;
    }
    memcpy(record.transform, is_moved ? use->transform : identity, sizeof record.transform);
    return record;
}

// True if the records are equal except for their texels.
static bool are_alike(const glint_texture_record *a, const glint_texture_record *b)
{
    for (int i = 0; i < 6; i++) {
        if (a->transform[i] != b->transform[i]) {
            return false;
        }
    }
    return a->width == b->width && a->height == b->height && a->levels == b->levels &&
           a->flags == b->flags;
}

// Returns the index of a record in the table, and adds it if it is new. The index of the first
// texel identifies the image.
static int place_of(glint_texture_table *table, const glint_texture_record *record)
{
    glint_texture_record *new = &table->records[table->count];
    *new = *record;
    new->alike = (int)table->count;
    for (size_t i = 0; i < table->count; i++) {
        if (are_alike(&table->records[i], record)) {
            new->alike = table->records[i].alike;
            if (table->records[i].first[0] == record->first[0]) {
                return (int)i;
            }
        }
    }
    return (int)table->count++;
}

glint_status glint_texture_table_make(const glint_scene *scene, glint_texture_table *table,
                                      glint_error *error)
{
    const size_t count = scene->material_count;
    *table = (glint_texture_table){
        .records = glint_allocate(count * GLINT_TEXTURE_SLOTS + 1, sizeof *table->records),
        .of_material = glint_allocate(count + 1, sizeof *table->of_material)};
    if (table->records == NULL || table->of_material == NULL) {
        glint_texture_table_free(table);
        return glint_fail_memory(error, "the materials");
    }
    for (size_t i = 0; i < count; i++) {
        for (int slot = 0; slot < GLINT_TEXTURE_SLOTS; slot++) {
            const glint_texture_use *use = &scene->materials[i].textures[slot];
            table->of_material[i][slot] = -1;
            if (use->image != 0 && scene->textures != NULL) {
                const glint_texture_record record = record_of(scene->textures, use);
                table->of_material[i][slot] = place_of(table, &record);
            }
        }
    }
    return GLINT_OK;
}

void glint_texture_table_free(glint_texture_table *table)
{
    free(table->records);
    free(table->of_material);
    *table = (glint_texture_table){0};
}

static glint_status fill_texels(const struct glint_device *device, glint_textures *textures,
                                glint_texture_memory *memory, glint_error *error)
{
    if (memory->texels != NULL && memory->textures == textures) {
        return GLINT_OK;
    }
    glint_buffer_release(&memory->texels);
    glint_textures_release(memory->textures);
    memory->textures = glint_textures_share(textures);
    const glint_content content = {"the textures", glint_textures_bytes(textures),
                                   textures != NULL ? textures->texels : NULL};
    return glint_buffer_share(device, &content, &memory->texels, error);
}

glint_status glint_texture_memory_fill(const struct glint_device *device, const glint_scene *scene,
                                       const glint_texture_table *table,
                                       glint_texture_memory *memory, glint_error *error)
{
    const glint_content records = {"the textures", table->count * sizeof *table->records,
                                   table->records};
    TRY(glint_buffer_fit(device, &records, &memory->records, error));
    return fill_texels(device, scene->textures, memory, error);
}

void glint_texture_memory_free(glint_texture_memory *memory)
{
    glint_buffer_release(&memory->records);
    glint_buffer_release(&memory->texels);
    glint_textures_release(memory->textures);
    *memory = (glint_texture_memory){0};
}
